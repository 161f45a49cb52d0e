# Compiler settings shared by every target of the project: one interface target, never global variables.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(spincat_compiler INTERFACE)
target_compile_features(spincat_compiler INTERFACE cxx_std_20)
target_compile_options(spincat_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Same bytes on every machine: no fused multiply-add unless the code asks for it. The other two cost nothing in
  # exactness (nobody here reads errno or floating-point traps) and let plain loops be vectorised.
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<BOOL:${SPINCAT_WERROR}>:-Werror>
  $<$<BOOL:${SPINCAT_ASSERTS}>:-UNDEBUG>)

# Headers that nearly every file needs, read once: half of what compiling a small file takes.
set(spincat_common_headers
  <algorithm> <array> <cmath> <cstddef> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
  <string_view> <utility> <variant> <vector> <Eigen/Core> <fmt/format.h>)

if(SPINCAT_SANITIZE)
  target_compile_options(spincat_compiler INTERFACE -fsanitize=${SPINCAT_SANITIZE} -fno-sanitize-recover=all
                                                    -fno-omit-frame-pointer)
  target_link_options(spincat_compiler INTERFACE -fsanitize=${SPINCAT_SANITIZE})
endif()

# What users run defends itself: an overwritten stack or a call into the middle of code ends the process, copies are
# checked against the size of what they go to, tables of addresses are read-only, code lies at random addresses.
# docs/results/reliability.md has the cost, tests/hardening the check.
if(SPINCAT_HARDEN AND NOT SPINCAT_SANITIZE)
  include(CheckCXXCompilerFlag)
  foreach(flag -fstack-protector-strong -fstack-clash-protection -fcf-protection)
    string(MAKE_C_IDENTIFIER "SPINCAT_HAS${flag}" has)
    check_cxx_compiler_flag(${flag} ${has})  # the last one is for x86 alone
    if(${has})
      target_compile_options(spincat_compiler INTERFACE $<$<CONFIG:Release>:${flag}>)
    endif()
  endforeach()
  # Position-independent as Debian's compiler makes everything, said for others; libraries and modules have -fPIC.
  target_compile_options(spincat_compiler INTERFACE
    $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=3>
    $<$<AND:$<CONFIG:Release>,$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>>:-fPIE>)
  target_link_options(spincat_compiler INTERFACE
    $<$<CONFIG:Release>:LINKER:-z,relro,-z,now>
    $<$<AND:$<CONFIG:Release>,$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>>:-pie>)
endif()
