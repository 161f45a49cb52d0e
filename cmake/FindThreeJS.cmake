# Debian's libjs-three: ThreeJS_SCRIPT and ThreeJS_CONTROLS, the files that reports with objects in 3D carry within them.
include(FindPackageHandleStandardArgs)
find_file(ThreeJS_SCRIPT three.min.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH)
find_file(ThreeJS_CONTROLS OrbitControls.js PATHS /usr/share/javascript/three/examples/js/controls NO_DEFAULT_PATH)
find_package_handle_standard_args(ThreeJS REQUIRED_VARS ThreeJS_SCRIPT ThreeJS_CONTROLS)
mark_as_advanced(ThreeJS_SCRIPT ThreeJS_CONTROLS)
