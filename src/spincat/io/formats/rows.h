// The ends of rows of text, and of what a file announces. Private to io.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "spincat/error.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {

// Whether these bytes are nothing but what some programs fill up a file with: blanks, zeros, the mark that ended text
// files once (Ctrl-Z).
inline bool is_padding(std::string_view bytes) {
  return std::ranges::all_of(bytes,
                             [](char c) { return c == '\0' || c == ' ' || (c >= '\t' && c <= '\r') || c == '\x1A'; });
}

// Throws where words follow all that the file announces.
inline void expect_end(TextCursor& text, const std::string& announced) {
  if (text.word_follows() && !is_padding(text.rest())) {
    text.fail("the file goes on after " + announced);
  }
}

// The same for bytes, where another row of so many would fit: fewer are harmless.
inline void expect_end(std::string_view rest, std::uint64_t row, const std::string& announced) {
  if (rest.size() >= row && !is_padding(rest)) {
    throw InputError(fmt::format("{} bytes follow {}", rest.size(), announced));
  }
}

inline std::size_t words_on_line(TextCursor text) {
  std::size_t words = 0;
  while (!text.word().empty()) {
    ++words;
  }
  return words;
}

// Rows of text may have more values than a header says, which are passed over when each has as many. A row that stands
// out is damaged: a value too many somewhere within it moves those behind it to wrong places.
class RowEnds {
 public:
  // To be called behind the values that a row should have. Leaves the cursor on its line.
  void check(const TextCursor& text) {
    const std::size_t more = TextCursor(text).word_on_line() ? words_on_line(text) : 0;
    if (line_ == 0) {
      line_ = text.line();
      more_ = more;
    } else if (more != more_) {
      text.fail(fmt::format("{} more values than a row should have, but {} more in line {}", more, more_, line_));
    }
  }

 private:
  std::size_t line_ = 0;  // of the first row
  std::size_t more_ = 0;
};

// The lines that hold a word, counted up to `most`.
inline std::uint64_t lines_with_words(TextCursor text, std::uint64_t most) {
  std::uint64_t lines = 0;
  for (; lines < most && text.word_follows(); text.skip_line()) {
    ++lines;
  }
  return lines;
}

}  // namespace spincat::io
