# Debian's tinygltf as a target that carries what its header includes (nlohmann's json.hpp by its short name):
# defines TinyGLTFPacked::TinyGLTFPacked.
include(FindPackageHandleStandardArgs)
find_path(TinyGLTFPacked_INCLUDE_DIR tiny_gltf.h)
find_path(TinyGLTFPacked_JSON_DIR json.hpp PATH_SUFFIXES nlohmann)
find_library(TinyGLTFPacked_LIBRARY tinygltf)
find_package_handle_standard_args(TinyGLTFPacked REQUIRED_VARS TinyGLTFPacked_LIBRARY TinyGLTFPacked_INCLUDE_DIR
                                                               TinyGLTFPacked_JSON_DIR)
if(TinyGLTFPacked_FOUND AND NOT TARGET TinyGLTFPacked::TinyGLTFPacked)
  add_library(TinyGLTFPacked::TinyGLTFPacked UNKNOWN IMPORTED)
  set_target_properties(TinyGLTFPacked::TinyGLTFPacked PROPERTIES
    IMPORTED_LOCATION ${TinyGLTFPacked_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${TinyGLTFPacked_INCLUDE_DIR};${TinyGLTFPacked_JSON_DIR}")
endif()
mark_as_advanced(TinyGLTFPacked_INCLUDE_DIR TinyGLTFPacked_JSON_DIR TinyGLTFPacked_LIBRARY)
