# librsvg's headers: Rsvg_INCLUDE_DIRS. The library itself is loaded when a picture is drawn, and not linked.
include(FindPackageHandleStandardArgs)
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Rsvg QUIET librsvg-2.0)
endif()
find_package_handle_standard_args(Rsvg REQUIRED_VARS Rsvg_INCLUDE_DIRS VERSION_VAR Rsvg_VERSION)
