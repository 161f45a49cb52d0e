// Which spincat this is.
#pragma once

namespace spincat {

// "0.2.0", as CMakeLists.txt has it.
extern const char* const kVersion;

// "spincat 0.2.0": what models, pages and other ranks are told.
extern const char* const kProgram;

}  // namespace spincat
