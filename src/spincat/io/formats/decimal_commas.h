// What commas mean between numbers: they part them, or are decimal marks. Private to io.
#pragma once

#include <string_view>

namespace spincat::io {

enum class Commas { none, separate, decimal, unclear };

// What those in a line of numbers are, without its comment. "1,2,3", "1, 2, 3": they part numbers. "0,5 1,25 2,0",
// "0 0 0,5", "0,5;1,25;2": blanks or semicolons do that, and commas are decimal marks. "1,234.5 2,000.0 1" and other
// lines in which both would be right, or neither, are unclear.
Commas commas_in(std::string_view line);

}  // namespace spincat::io
