#include "spincat/files/text_encoding.h"

#include <gtest/gtest.h>

#include <string>

#include "support/expect_error.h"

namespace spincat {
namespace {

using namespace std::string_literals;

TEST(TextEncoding, DecodesEitherByteOrder) {
  EXPECT_EQ(utf8_of_utf16("\xFF\xFEv\0 \0\n\0"s), "v \n");
  EXPECT_EQ(utf8_of_utf16("\xFE\xFF\0v\0 \0\n"s), "v \n");
  EXPECT_EQ(utf8_of_utf16("v\0 \0001\0\n\0"s), "v 1\n");
  EXPECT_EQ(utf8_of_utf16("\0v\0 \0001\0\n"s), "v 1\n");
}

TEST(TextEncoding, DecodesAllCharacters) {
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE"s + "a\0b\0c\0d\0"s + "\xE4\0\xAC\x20\x3D\xD8\x00\xDE"s),
            "abcd\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(utf8_of_utf16("\xFE\xFF"s + "\0a\0b\0c\0d"s + "\0\xE4\x20\xAC\xD8\x3D\xDE\x00"s),
            "abcd\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
}

TEST(TextEncoding, MendsHalvesThatStandAlone) {
  const std::string lost = "\xEF\xBF\xBD";
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE"s + "a\0b\0\x3D\xD8"s), "ab" + lost);
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE"s + "a\0b\0\x3D\xD8z\0"s), "ab" + lost + "z");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE"s + "a\0\x00\xDEz\0\0"s), "a" + lost + "z");  // and half a unit
}

TEST(TextEncoding, LeavesOtherBytesAlone) {
  for (const std::string& bytes :
       {""s, "a"s, "\xFF\xFE"s, "OFF\n1 0 0\n"s, "\xEF\xBB\xBFOFF\n"s, "a\0"s, "\xFF\xFE\x12\x42\x01\x43"s,
        "v\0 \0001\0\n"s, "\0\0\0\0\0\0\0\0"s, "\xFF\xFE\0\0"s}) {
    EXPECT_EQ(utf8_of_utf16(bytes), std::nullopt) << bytes;
  }
}

TEST(TextEncoding, NamesUtf32) {
  const std::string problem = "is text in UTF-32; UTF-8 or UTF-16 is expected";
  EXPECT_EQ(test::input_error([] { utf8_of_utf16("\xFF\xFE\0\0v\0\0\0"s); }), problem);
  EXPECT_EQ(test::input_error([] { utf8_of_utf16("\0\0\xFE\xFF\0\0\0v"s); }), problem);
}

}  // namespace
}  // namespace spincat
