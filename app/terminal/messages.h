// Standard error: everything that is no result.
#pragma once

#include <string_view>

namespace spincat::app {

// Prints "spincat: TEXT" as one line, whatever is in the text. Never throws: a message that cannot be delivered
// (standard error closed, disk full) is no reason to fail.
void message(std::string_view text);

// Prints as it is, without a line's end; never throws.
void print_to_stderr(std::string_view text);

// Opens /dev/null in place of standard streams that the caller has closed, so that no file of ours gets their number
// and then the text that was meant for them.
void fill_closed_streams();

}  // namespace spincat::app
