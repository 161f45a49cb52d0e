# Every library comes from Debian 12 packages (scripts/setup lists them).
# docs/how-it-works/dependencies.md says why each was chosen.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nanoflann REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(hwy 1.0.3 REQUIRED)
find_package(Threads REQUIRED)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_package(LibSVM 3.24 REQUIRED)
find_package(TinyGLTFPacked REQUIRED)
find_package(LodePNG REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco 1.5 QUIET CONFIG)  # optional: glTF files that it has compressed
find_package(EXPAT REQUIRED)
find_package(Rsvg REQUIRED)
find_package(ThreeJS REQUIRED)
if(PROJECT_IS_TOP_LEVEL)
  find_package(CLI11 2.1 REQUIRED)
endif()
