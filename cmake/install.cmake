# The installed library, the command, and a CMake package: find_package(spincat) gives spincat::spincat.
include(CMakePackageConfigHelpers)

install(TARGETS spincat_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS spincat EXPORT spincat_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/spincat/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spincat
        FILES_MATCHING PATTERN "*.h"
        # private headers, which name libraries that users need not have
        PATTERN "record_file.h" EXCLUDE
        PATTERN "settings_json.h" EXCLUDE
        PATTERN "point_tree.h" EXCLUDE
        PATTERN "kernel.h" EXCLUDE
        PATTERN "support.h" EXCLUDE
        PATTERN "surface_groups.h" EXCLUDE
        PATTERN "in_order.h" EXCLUDE
        PATTERN "unit_length.h" EXCLUDE)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spincat)
install(EXPORT spincat_targets NAMESPACE spincat:: DESTINATION ${package_dir})
configure_package_config_file(cmake/spincatConfig.cmake.in ${PROJECT_BINARY_DIR}/spincatConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spincatConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spincatConfig.cmake ${PROJECT_BINARY_DIR}/spincatConfigVersion.cmake
              cmake/FindLibSVM.cmake cmake/FindTinyGLTFPacked.cmake
        DESTINATION ${package_dir})
