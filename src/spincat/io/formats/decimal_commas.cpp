#include "spincat/io/formats/decimal_commas.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr std::string_view kSeparators = " \t\v\f\r;";

// What is seen of the words between blanks and semicolons.
struct Words {
  std::size_t count = 0;
  bool between_digits = false;  // a comma as in 0,5
  bool elsewhere = false;       // a comma that is no decimal mark: "1, 2", "1,-2"
  bool early = false;           // such a comma in one of the first three words
  bool with_point = false;      // a decimal point
  bool all_numbers = true;      // each word is a number, with a decimal comma or without
};

bool is_number_with_comma(std::string_view word) {
  std::string number(word);
  const std::size_t comma = number.find(',');
  if (comma != std::string::npos) {
    number[comma] = '.';
  }
  return is_number(number);
}

void look_at_word(std::string_view word, Words& words) {
  ++words.count;
  for (std::size_t at = word.find(','); at != std::string_view::npos; at = word.find(',', at + 1)) {
    const bool inside = at > 0 && at + 1 < word.size() && is_digit(word[at - 1]) && is_digit(word[at + 1]);
    (inside ? words.between_digits : words.elsewhere) = true;
    words.early = words.early || words.count <= 3;
  }
  words.with_point = words.with_point || word.find('.') != std::string_view::npos;
  words.all_numbers = words.all_numbers && is_number_with_comma(word);
}

Words words_of(std::string_view line) {
  Words words;
  for (std::size_t at = line.find_first_not_of(kSeparators); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    look_at_word(line.substr(at, end - at), words);
    at = line.find_first_not_of(kSeparators, end);
  }
  return words;
}

}  // namespace

Commas commas_in(std::string_view line) {
  if (line.find(',') == std::string_view::npos) {
    return Commas::none;
  }
  const std::size_t first = line.find_first_not_of(kSeparators);
  if (line.substr(first, line.find_last_not_of(kSeparators) + 1 - first).find_first_of(kSeparators) ==
      std::string_view::npos) {
    return Commas::separate;  // one word, as in most files with commas
  }
  const Words words = words_of(line);
  if (!words.between_digits) {
    return Commas::separate;
  }
  if (words.all_numbers && !words.with_point && !words.elsewhere) {
    return Commas::decimal;
  }
  return words.early ? Commas::unclear : Commas::separate;
}

}  // namespace spincat::io
