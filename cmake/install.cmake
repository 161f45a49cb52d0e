# The installed library, the command, and a CMake package: find_package(spincat) gives spincat::spincat.
include(CMakePackageConfigHelpers)

# A header whose first line says "Private" belongs to the library alone and is not installed: it may name libraries that
# users need not have, and may change without notice.
file(GLOB_RECURSE public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/spincat/*.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_headers})
foreach(header ${public_headers})
  file(STRINGS ${header} first_line LIMIT_COUNT 1)
  if(first_line MATCHES "Private")
    list(REMOVE_ITEM public_headers ${header})
  endif()
endforeach()
target_sources(spincat PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${public_headers})

# Models hold Eigen matrices, and Eigen allocates these in another way where it is allowed wider vectors. Whoever compiles
# with -march=native must still be able to free what the library, built for every machine, has allocated. Without such
# options these are Eigen's own values.
if(CMAKE_SIZEOF_VOID_P EQUAL 8)
  target_compile_definitions(spincat INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=16>
                                               $<INSTALL_INTERFACE:EIGEN_MALLOC_ALREADY_ALIGNED=1>)
endif()

if(TARGET spincat_command)
  install(TARGETS spincat_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(TARGETS spincat EXPORT spincat_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spincat)
install(EXPORT spincat_targets NAMESPACE spincat:: DESTINATION ${package_dir})
configure_package_config_file(cmake/spincatConfig.cmake.in ${PROJECT_BINARY_DIR}/spincatConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spincatConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spincatConfig.cmake ${PROJECT_BINARY_DIR}/spincatConfigVersion.cmake
              cmake/FindLibSVM.cmake cmake/FindTinyGLTFPacked.cmake
              cmake/FindLodePNG.cmake
        DESTINATION ${package_dir})
