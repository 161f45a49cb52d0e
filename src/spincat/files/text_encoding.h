// Text that is not in UTF-8.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace spincat {

// The text in UTF-8 where the bytes are UTF-16, in either byte order: with a byte order mark, or without one where the
// text begins with ASCII. Nothing where they are not, so also for bytes that are no text. Halves of a pair that stand
// alone become U+FFFD. Throws InputError (without a file name) for UTF-32.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);

}  // namespace spincat
