# The installed library, the command, and what find_package(spincat) and pkg-config read: both give the library, static
# unless BUILD_SHARED_LIBS is on.
include(CMakePackageConfigHelpers)

# What users may include. A new one is named here and in spincat.h; it may include only these and Eigen.
set(public_headers
  spincat.h error.h execution.h range.h
  geometry/object.h geometry/oriented_points.h
  io/read_limits.h io/read_object.h io/write_object.h
  dataset/dataset.h dataset/splits.h
  prepare/prepare.h prepare/point_normals.h
  spin/params.h spin/spin_images.h spin/spin_image_maker.h
  encode/feature_vector.h
  judge/settings.h judge/ballot.h
  camera/source/frame_source.h camera/segment/scene.h
  settings/settings.h settings/setting_table.h
  describe/describe.h
  classify/model.h classify/classify.h classify/evidence.h classify/recogniser.h
  train/train.h
  evaluate/evaluate.h evaluate/rates.h evaluate/sweep.h
  report/report.h)
list(TRANSFORM public_headers PREPEND ${PROJECT_SOURCE_DIR}/src/spincat/)

# OrientedPoints and others hold Eigen's matrices, and Eigen allocates these in another way where it is allowed wider
# vectors. Whoever compiles with -march=native must still be able to free what the library, built for every machine, has
# allocated. Without such options these are Eigen's own values.
set(public_definitions EIGEN_DONT_PARALLELIZE)
if(CMAKE_SIZEOF_VOID_P EQUAL 8)
  list(APPEND public_definitions EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Installs one of the two libraries with all that goes with it. Further arguments are install()'s, for every file, instead
# of the components library and development.
function(spincat_install_library target)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spincat)
  set(made ${PROJECT_BINARY_DIR}/package/${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME spincat)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${public_headers})
  list(TRANSFORM public_definitions REPLACE "(.+)" "$<INSTALL_INTERFACE:\\1>" OUTPUT_VARIABLE definitions)
  target_compile_definitions(${target} INTERFACE ${definitions})
  # What programs run with, and what they are built with, are packages of their own (cmake/packages.cmake).
  set(runs_with COMPONENT library NAMELINK_COMPONENT development)
  set(built_with COMPONENT development)
  if(ARGN)
    set(runs_with ${ARGN})
    set(built_with ${ARGN})
  endif()
  install(TARGETS ${target} EXPORT ${target}_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${built_with}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ${runs_with}
          FILE_SET HEADERS ${built_with})
  install(EXPORT ${target}_targets NAMESPACE spincat:: DESTINATION ${package_dir} ${built_with})

  get_target_property(type ${target} TYPE)
  string(COMPARE EQUAL ${type} STATIC_LIBRARY is_static)
  configure_package_config_file(cmake/spincatConfig.cmake.in ${made}/spincatConfig.cmake INSTALL_DESTINATION ${package_dir})
  write_basic_package_version_file(${made}/spincatConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${made}/spincatConfig.cmake ${made}/spincatConfigVersion.cmake cmake/FindLibSVM.cmake
                cmake/FindTinyGLTFPacked.cmake cmake/FindLodePNG.cmake
          DESTINATION ${package_dir} ${built_with})

  # Found from wherever the prefix is moved to.
  file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  list(TRANSFORM public_definitions PREPEND "-D" OUTPUT_VARIABLE flags)
  list(JOIN flags " " definition_flags)
  if(draco_FOUND)
    set(draco_library -ldraco)
  endif()
  configure_file(cmake/spincat.pc.in ${made}/spincat.pc @ONLY)
  install(FILES ${made}/spincat.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig ${built_with})
endfunction()

if(TARGET spincat_command)
  install(TARGETS spincat_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
endif()
if(BUILD_SHARED_LIBS)
  spincat_install_library(spincat_shared)
else()
  spincat_install_library(spincat)
  # For the tests, and for whoever wants both from one build: cmake --build ... --target spincat_shared, then
  # cmake --install ... --component shared.
  spincat_install_library(spincat_shared COMPONENT shared EXCLUDE_FROM_ALL)
endif()
