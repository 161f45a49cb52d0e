# Compiler settings shared by every target of the project: one interface target, never global variables.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(spincat_compiler INTERFACE)
target_compile_features(spincat_compiler INTERFACE cxx_std_20)
target_compile_options(spincat_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Same bytes on every machine: no fused multiply-add unless the code asks for it. The other two cost nothing in
  # exactness (nobody here reads errno or floating-point traps) and let plain loops be vectorised: docs/performance.md.
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<BOOL:${SPINCAT_WERROR}>:-Werror>
  $<$<BOOL:${SPINCAT_ASSERTS}>:-UNDEBUG>
  $<$<CONFIG:Release>:-O3>)

if(SPINCAT_SANITIZE)
  target_compile_options(spincat_compiler INTERFACE -fsanitize=${SPINCAT_SANITIZE} -fno-sanitize-recover=all
                                                    -fno-omit-frame-pointer)
  target_link_options(spincat_compiler INTERFACE -fsanitize=${SPINCAT_SANITIZE})
endif()
