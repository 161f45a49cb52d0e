# Uses spincat as a stranger would: installs the built project into an empty prefix, builds the examples against it with
# nothing but CMake's defaults, and runs them, and compiles the pieces of its guide; then the same by pkg-config, from a shared object of the stranger's own,
# and with the shared library. Called by ctest with
#
#   cmake -DSOURCE_DIR=... -DBINARY_DIR=... -DSCRATCH_DIR=... [-DCXX=...] -P check.cmake
set(prefix ${SCRATCH_DIR}/prefix)
set(shared_prefix ${SCRATCH_DIR}/shared)
set(train_and_name ${SCRATCH_DIR}/train_and_name/train_and_name)

# Runs a command, whose output is only shown when its exit status is not the expected one. Leaves it in `out` and `err`.
function(expect status)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result STREQUAL status)
    list(JOIN ARGN " " command)
    message(NOTICE "${command}\n${out}${err}")
    message(FATAL_ERROR "ended with ${result}, not ${status}: see above")
  endif()
  set(out "${out}" PARENT_SCOPE)
  set(err "${err}" PARENT_SCOPE)
endfunction()

function(expect_text text pattern)
  if(NOT text MATCHES "${pattern}")
    message(NOTICE "${text}")
    message(FATAL_ERROR "the text above is not as expected: ${pattern}")
  endif()
endfunction()

# The defaults are plain CMake's (but Ninja, which is what a bare machine has): the environment's flags are not passed on.
function(build_against where source binary)
  expect(0 ${CMAKE_COMMAND} -E env --unset=CXXFLAGS --unset=LDFLAGS ${CMAKE_COMMAND} -S ${SOURCE_DIR}/${source} -B ${binary}
    -G Ninja -DCMAKE_PREFIX_PATH=${where} -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  expect(0 ${CMAKE_COMMAND} --build ${binary} --parallel 2)
endfunction()

# A box with the given edges, as an OFF file.
function(write_box file x y z)
  file(WRITE ${file} "OFF\n8 6 0\n0 0 0\n${x} 0 0\n${x} ${y} 0\n0 ${y} 0\n0 0 ${z}\n${x} 0 ${z}\n${x} ${y} ${z}\n0 ${y} ${z}\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")
endfunction()

# An organized cloud: a wall one metre before a small camera.
function(write_frame file)
  set(text "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 32\nHEIGHT 24\n"
           "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 768\nDATA ascii\n")
  foreach(v RANGE 23)
    math(EXPR y "(2 * ${v} - 23) * 15625")
    foreach(u RANGE 31)
      math(EXPR x "(2 * ${u} - 31) * 15625")
      list(APPEND text "${x}e-6 ${y}e-6 1\n")
    endforeach()
  endforeach()
  file(WRITE ${file} ${text})
endfunction()

# Compiles one of the examples by pkg-config alone. Further arguments are pkg-config's.
function(build_by_pkg_config where name binary)
  set(ENV{PKG_CONFIG_PATH} ${where}/lib/pkgconfig)
  expect(0 ${PKG_CONFIG} ${ARGN} --cflags --libs spincat)
  separate_arguments(flags UNIX_COMMAND "${out}")
  expect(0 ${CXX} -std=c++20 ${SOURCE_DIR}/examples/${name}/main.cpp -o ${binary} ${flags} -Wl,-rpath,${where}/lib)
endfunction()

file(REMOVE_RECURSE ${SCRATCH_DIR})
expect(0 ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${prefix})
build_against(${prefix} tests/consumer/headers ${SCRATCH_DIR}/headers)
build_against(${prefix} tests/consumer/guide ${SCRATCH_DIR}/guide -DGUIDE=${SOURCE_DIR}/docs/guide/library.md)
foreach(example train_and_name spin_images depth_camera)
  build_against(${prefix} examples/${example} ${SCRATCH_DIR}/${example})
endforeach()

expect(2 ${train_and_name})
expect_text("${err}" "^usage: train_and_name DATASET MODEL FILE\\.\\.\\.\n$")
expect(1 ${train_and_name} ${SCRATCH_DIR}/none ${SCRATCH_DIR}/none ${SCRATCH_DIR}/none)
expect_text("${err}" "^train_and_name: [^\n]*none: [^\n]+\n$")

# Learns boards and sticks; then names one of each, and one file that is neither.
foreach(i RANGE 1 3)
  write_box(${SCRATCH_DIR}/boxes/board/${i}.off 1.${i} 1 0.05)
  write_box(${SCRATCH_DIR}/boxes/stick/${i}.off 1.${i} 0.05 0.06)
endforeach()
write_box(${SCRATCH_DIR}/board.off 1.25 1.1 0.05)
write_box(${SCRATCH_DIR}/stick.off 0.05 1.25 0.05)
file(WRITE ${SCRATCH_DIR}/nonsense "no object at all\n")
set(objects ${SCRATCH_DIR}/board.off ${SCRATCH_DIR}/nonsense ${SCRATCH_DIR}/stick.off)
set(names "board.off: board \\(confidence [^\n]*, runner-up stick\\)\n.*stick.off: stick ")
expect(1 ${train_and_name} ${SCRATCH_DIR}/boxes ${SCRATCH_DIR}/boxes.spincat ${objects})
expect_text("${out}" "${names}")
expect_text("${err}" "training judges: [0-9]+ done\ntrain_and_name: [^\n]*nonsense: [^\n]+\n$")
# The command reads the same model, and would have written the same bytes.
expect(0 ${prefix}/bin/spincat train ${SCRATCH_DIR}/boxes -o ${SCRATCH_DIR}/command.spincat --quiet)
expect(0 ${CMAKE_COMMAND} -E compare_files ${SCRATCH_DIR}/boxes.spincat ${SCRATCH_DIR}/command.spincat)

expect(0 ${SCRATCH_DIR}/spin_images/spin_images)
expect_text("${out}" "^100 spin images of 16 x 16\nlikeness [^\n]*: 0\\.[5-9][0-9]* for the side, -?0\\.[0-4][0-9]* for the lid\n$")
write_frame(${SCRATCH_DIR}/frames/1.pcd)
write_frame(${SCRATCH_DIR}/frames/2.pcd)
expect(0 ${SCRATCH_DIR}/depth_camera/depth_camera ${SCRATCH_DIR}/boxes.spincat ${SCRATCH_DIR}/frames)
expect_text("${out}" "^1.pcd: 0 objects\n2.pcd: 0 objects\n$")

# Wider vectors in the consumer than in the library: see cmake/install.cmake.
build_against(${prefix} examples/train_and_name ${SCRATCH_DIR}/native -DCMAKE_CXX_FLAGS=-march=native)
expect(1 ${SCRATCH_DIR}/native/train_and_name ${SCRATCH_DIR}/boxes ${SCRATCH_DIR}/native.spincat ${objects})
expect_text("${out}" "${names}")

# A stranger's shared object that holds the static library, as a plug-in or a Python module does.
build_against(${prefix} tests/consumer/plugin ${SCRATCH_DIR}/plugin)
expect(0 ${SCRATCH_DIR}/plugin/loader ${SCRATCH_DIR}/plugin/libplugin.so ${SCRATCH_DIR}/boxes.spincat
  ${SCRATCH_DIR}/board.off)
expect_text("${out}" "^board\n$")

# The shared library, which shows nothing of the inside. Without the static one beside it.
expect(0 ${CMAKE_COMMAND} --build ${BINARY_DIR} --target spincat_shared)
expect(0 ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${shared_prefix} --component shared)
if(EXISTS ${shared_prefix}/lib/libspincat.a OR NOT EXISTS ${shared_prefix}/lib/libspincat.so.0)
  message(FATAL_ERROR "the shared library is not installed as it should be")
endif()
expect(0 nm -D --defined-only -C ${shared_prefix}/lib/libspincat.so)
foreach(inside TaskFarm Packer Journal GramMatrices JudgeTrainer)
  if(out MATCHES "spincat::${inside}::")
    message(FATAL_ERROR "the shared library shows spincat::${inside}")
  endif()
endforeach()
build_against(${shared_prefix} examples/train_and_name ${SCRATCH_DIR}/with_shared)
expect(1 ${SCRATCH_DIR}/with_shared/train_and_name ${SCRATCH_DIR}/boxes ${SCRATCH_DIR}/shared.spincat ${objects})
expect_text("${out}" "${names}")
expect(0 ${CMAKE_COMMAND} -E compare_files ${SCRATCH_DIR}/boxes.spincat ${SCRATCH_DIR}/shared.spincat)

find_program(PKG_CONFIG NAMES pkg-config pkgconf)
if(NOT PKG_CONFIG)
  message(NOTICE "skipped what needs pkg-config: it is not installed")
  return()
endif()
build_by_pkg_config(${prefix} spin_images ${SCRATCH_DIR}/by_pkg_config --static)
expect(0 ${SCRATCH_DIR}/by_pkg_config)
expect_text("${out}" "^100 spin images")
build_by_pkg_config(${shared_prefix} spin_images ${SCRATCH_DIR}/shared_by_pkg_config)
expect(0 ${SCRATCH_DIR}/shared_by_pkg_config)
expect_text("${out}" "^100 spin images")
