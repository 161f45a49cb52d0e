// The first bytes of every file that spincat writes for itself. 0x1A stops a listing of it on a terminal.
#pragma once

#include <string_view>

namespace spincat {

inline constexpr std::string_view kFileMagic("SPINCAT\x1A", 8);

}  // namespace spincat
