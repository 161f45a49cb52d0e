# Uses spincat as a stranger would: installs the built project into an empty prefix, builds examples/name_objects against
# it with nothing but CMake's defaults, and runs it. Called by ctest with
#
#   cmake -DSOURCE_DIR=... -DBINARY_DIR=... -DSCRATCH_DIR=... [-DCXX=...] -P check.cmake
set(prefix ${SCRATCH_DIR}/prefix)
set(name_objects ${SCRATCH_DIR}/name_objects/name_objects)

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
function(build_against_prefix source binary)
  expect(0 ${CMAKE_COMMAND} -E env --unset=CXXFLAGS --unset=LDFLAGS ${CMAKE_COMMAND} -S ${source} -B ${binary}
    -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  expect(0 ${CMAKE_COMMAND} --build ${binary} --parallel 2)
endfunction()

# A box with the given edges, as an OFF file.
function(write_box file x y z)
  file(WRITE ${file} "OFF\n8 6 0\n0 0 0\n${x} 0 0\n${x} ${y} 0\n0 ${y} 0\n0 0 ${z}\n${x} 0 ${z}\n${x} ${y} ${z}\n0 ${y} ${z}\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")
endfunction()

file(REMOVE_RECURSE ${SCRATCH_DIR})
expect(0 ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${prefix})
build_against_prefix(${SOURCE_DIR}/tests/consumer/headers ${SCRATCH_DIR}/headers)
build_against_prefix(${SOURCE_DIR}/examples/name_objects ${SCRATCH_DIR}/name_objects)

expect(2 ${name_objects})
expect_text("${err}" "^usage: name_objects MODEL FILE\\.\\.\\.\n$")

file(WRITE ${SCRATCH_DIR}/nonsense "no model at all\n")
expect(1 ${name_objects} ${SCRATCH_DIR}/nonsense ${SCRATCH_DIR}/nonsense)
expect_text("${err}" "^name_objects: [^\n]*nonsense: [^\n]+\n$")

# The installed command trains boards and sticks; the example names one of each, and one file that is neither.
foreach(i RANGE 1 3)
  write_box(${SCRATCH_DIR}/boxes/board/${i}.off 1.${i} 1 0.05)
  write_box(${SCRATCH_DIR}/boxes/stick/${i}.off 1.${i} 0.05 0.06)
endforeach()
write_box(${SCRATCH_DIR}/board.off 1.25 1.1 0.05)
write_box(${SCRATCH_DIR}/stick.off 0.05 1.25 0.05)
expect(0 ${prefix}/bin/spincat train ${SCRATCH_DIR}/boxes -o ${SCRATCH_DIR}/boxes.spincat --quiet)
expect(1 ${name_objects} ${SCRATCH_DIR}/boxes.spincat ${SCRATCH_DIR}/board.off ${SCRATCH_DIR}/nonsense
  ${SCRATCH_DIR}/stick.off)
expect_text("${out}" "board.off: board \\(confidence [^\n]*, runner-up stick\\)\n.*stick.off: stick ")
expect_text("${err}" "^name_objects: [^\n]*nonsense: [^\n]+\n$")

# Wider vectors in the consumer than in the library: see cmake/install.cmake.
build_against_prefix(${SOURCE_DIR}/examples/name_objects ${SCRATCH_DIR}/native -DCMAKE_CXX_FLAGS=-march=native)
expect(0 ${SCRATCH_DIR}/native/name_objects ${SCRATCH_DIR}/boxes.spincat ${SCRATCH_DIR}/board.off)
