// Walks through a text file that is wholly in memory, word by word, and knows its line. Private to the library.
//
// Words are separated by blanks; lines end with \n, \r\n or \r; comments run to the end of their line. Nothing here
// depends on the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace spincat::io {

struct TextStyle {
  bool hash_comments = true;         // # begins a comment
  bool slash_comments = false;       // and so does //
  bool commas_separate = false;      // so do semicolons
  bool backslash_continues = false;  // a \ at the end of a line joins it with the next
};

// A piece of a file, cut short and printable, for error messages; and the same in quotes.
std::string shown(std::string_view text);
std::string in_quotes(std::string_view text);

// Whether two words are equal but for upper and lower case.
bool same_word(std::string_view a, std::string_view b);

// Whether a word is a number, wholly.
bool is_number(std::string_view word);

class TextCursor {
 public:
  explicit TextCursor(std::string_view text, TextStyle style = {}, std::size_t first_line = 1);

  // Skips blanks and comments; whether a word follows on this line.
  bool word_on_line();
  // Skips line ends too; whether a word follows at all.
  bool word_follows();
  // Goes to the beginning of the next line.
  void skip_line();

  // The next word without taking it; empty when none follows on this line.
  std::string_view peek();
  // The next word on this line; empty when none follows.
  std::string_view word();
  // Takes the first characters of the next word only.
  void take(std::size_t characters) { at_ += characters; }
  // The rest of the line, comments included.
  std::string_view rest_of_line() const;
  // All that follows.
  std::string_view rest() const { return {at_, bytes_left()}; }

  // The next word on this line, or on a later one after word_follows(), as a number. `what` is named in the error when
  // there is none: "line 7: expected a coordinate, found 'abc'".
  double number(const char* what);
  // The same, and it must be finite.
  double finite_number(const char* what);
  std::int64_t integer(const char* what);
  std::uint64_t count(const char* what);

  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  // "line 7: " and the problem, as an InputError.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  bool is_comment(const char* at) const;
  bool take_continuation();
  void skip_line_end();
  bool at_word_end(const char* at) const;
  [[noreturn]] void fail_expecting(const char* what);

  const char* at_;
  const char* end_;
  std::size_t line_;
  TextStyle style_;
};

}  // namespace spincat::io
