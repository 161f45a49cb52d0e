#include "spincat/io/formats/likeness.h"

#include <algorithm>
#include <array>
#include <optional>

#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/column_names.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using namespace std::string_view_literals;

bool is_one_of(std::string_view word, auto words) {
  return std::ranges::find(words, word) != words.end();
}

Likeness plain_if(bool is_plain) {
  return is_plain ? Likeness::plain : Likeness::none;
}

// The lines of a file's beginning, without the last where the file goes on behind it.
std::string_view whole_lines(std::string_view first, std::uint64_t file_size) {
  return first.size() == file_size ? first : first.substr(0, first.find_last_of("\r\n") + 1);
}

// The word without [ST][C][N][4][n]OFF at its beginning; nothing where it does not begin so.
std::optional<std::string_view> behind_off(std::string_view word) {
  for (const std::string_view letters : {"ST"sv, "C"sv, "N"sv, "4"sv, "n"sv}) {
    word.remove_prefix(word.starts_with(letters) ? letters.size() : 0);
  }
  return same_word(word.substr(0, 3), "OFF") ? std::optional(word.substr(3)) : std::nullopt;
}

// Three numbers, and further words where they are numbers, too.
bool is_row(TextCursor& text) {
  std::size_t numbers = 0;
  while (text.word_on_line()) {
    if (!is_number(text.word())) {
      return false;
    }
    ++numbers;
  }
  return numbers >= 3;
}

bool is_lone_count(TextCursor text) {
  const std::string_view word = text.word();
  return !word.empty() && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; }) &&
         !text.word_on_line();
}

}  // namespace

Likeness likeness_of_off(std::string_view first, std::uint64_t) {
  TextCursor text(first);
  text.word_follows();
  const std::string_view word = text.word();
  text.word_follows();
  const auto glued = behind_off(word);
  const std::string_view next = glued && glued->empty() ? text.peek() : glued.value_or("");
  if (next == "BINARY" || is_number(next)) {
    return Likeness::plain;
  }
  return is_number(word) ? Likeness::possible : Likeness::none;
}

Likeness likeness_of_obj(std::string_view first, std::uint64_t file_size) {
  constexpr std::array kWords = {"v"sv, "vt"sv, "vn"sv, "vp"sv, "f"sv,      "l"sv,
                                 "p"sv, "g"sv,  "o"sv,  "s"sv,  "usemtl"sv, "mtllib"sv};
  TextCursor text(whole_lines(first, file_size));
  std::size_t vertices = 0;
  for (; text.word_follows(); text.skip_line()) {
    const std::string_view word = text.word();
    if (!is_one_of(word, kWords)) {
      return Likeness::none;
    }
    vertices += word == "v" && is_row(text) ? 1 : 0;
  }
  return plain_if(vertices > 0);
}

Likeness likeness_of_ply(std::string_view first, std::uint64_t) {
  constexpr std::array kSecond = {"format"sv, "comment"sv, "obj_info"sv};
  TextCursor text(first, {.hash_comments = false});
  const bool begins = text.word() == "ply" && !text.word_on_line();
  return plain_if(begins && text.word_follows() && is_one_of(text.word(), kSecond));
}

// Text where a facet follows in one of the first lines; bytes where the size is that of the triangles announced.
Likeness likeness_of_stl(std::string_view first, std::uint64_t file_size) {
  constexpr std::size_t kHeader = 84;
  constexpr std::uint64_t kTriangle = 50;
  if (first.size() >= kHeader) {
    const std::uint64_t triangles = load<std::uint32_t>(first.data() + kHeader - 4);
    if (triangles > 0 && file_size == kHeader + kTriangle * triangles) {
      return Likeness::plain;
    }
  }
  TextCursor text(first, {.hash_comments = false});
  text.word_follows();
  if (!same_word(text.word(), "solid")) {
    return Likeness::possible;
  }
  constexpr int kLines = 10;
  text.skip_line();
  for (int i = 0; i < kLines && text.word_follows(); ++i, text.skip_line()) {
    if (same_word(text.peek(), "facet")) {
      return Likeness::plain;
    }
  }
  return Likeness::possible;
}

Likeness likeness_of_pcd(std::string_view first, std::uint64_t) {
  constexpr std::array kWords = {"VERSION"sv, "FIELDS"sv, "COLUMNS"sv};
  TextCursor text(first);
  return plain_if(text.word_follows() && is_one_of(text.word(), kWords));
}

Likeness likeness_of_gltf(std::string_view first, std::uint64_t) {
  if (first.starts_with("glTF")) {
    return Likeness::plain;
  }
  TextCursor text(first, {.hash_comments = false});
  return plain_if(text.word_follows() && text.peek()[0] == '{' && first.find("\"asset\"") != std::string_view::npos);
}

Likeness likeness_of_xyz(std::string_view first, std::uint64_t file_size) {
  constexpr std::size_t kLeastRows = 5;
  TextCursor text(whole_lines(first, file_size), {.slash_comments = true, .commas_separate = true});
  bool is_first = true;
  bool has_counts = false;
  std::size_t rows = 0;
  for (; text.word_follows(); text.skip_line()) {
    const std::string_view line = text.rest_of_line();
    if ((is_first || has_counts) && is_lone_count(text)) {
      has_counts = true;
    } else if (is_row(text)) {
      ++rows;
    } else if (rows > 0 || !column_names(line)) {
      return Likeness::none;
    }
    is_first = false;
  }
  if (rows == 0) {
    return Likeness::none;
  }
  return rows < kLeastRows ? Likeness::possible : Likeness::plain;
}

std::string_view unread_kind(std::string_view first) {
  struct Kind {
    std::string_view begin, name;
  };
  static constexpr std::array kKinds = {
      Kind{"PK\x03\x04", "a zip archive"},
      Kind{"\x1F\x8B", "a file packed by gzip"},
      Kind{"BZh", "a file packed by bzip2"},
      Kind{"\xFD\x37zXZ", "a file packed by xz"},
      Kind{"7z\xBC\xAF", "a 7-Zip archive"},
      Kind{"Kaydara FBX", "an FBX file"},
      Kind{"; FBX", "an FBX file"},
      Kind{"BLENDER", "a Blender file"},
      Kind{"#VRML", "a VRML file"},
      Kind{"ISO-10303-21", "a STEP file"},
      Kind{"\x89PNG", "a PNG picture"},
      Kind{"\xFF\xD8\xFF", "a JPEG picture"},
      Kind{"version https://git-lfs", "a pointer of Git LFS; 'git lfs pull' fetches the file itself"},
      Kind{"<!DOCTYPE html", "a web page"},
      Kind{"<html", "a web page"},
      Kind{"<?xml", "an XML file"},
  };
  const auto* const found =
      std::ranges::find_if(kKinds, [&](const Kind& kind) { return first.starts_with(kind.begin); });
  return found == kKinds.end() ? std::string_view() : found->name;
}

}  // namespace spincat::io
