#include "spincat/io/text_cursor.h"

#include <gtest/gtest.h>

#include <string>

#include "support/expect_error.h"

namespace spincat::io {
namespace {

double number_in(const std::string& text) {
  return TextCursor(text).number("a number");
}

TEST(TextCursor, TakesWhatIsTooSmallForANumberAsNothing) {
  const std::string zeros(400, '0');
  for (const std::string& tiny :
       {std::string("1e-999"), std::string("-1E-999"), "0." + zeros + "1", "." + zeros + "123", "-0." + zeros + "1e+5",
        "1" + zeros + "e-999", std::string("1e-99999999999999999999"), "0" + zeros + ".0e-5", "1e-0" + zeros + "999"}) {
    EXPECT_EQ(number_in(tiny), 0.0) << tiny;
  }
}

TEST(TextCursor, RefusesWhatIsTooLargeForANumber) {
  const std::string ones(400, '1');
  for (const std::string& large : {std::string("1e999"), std::string("-1E+999"), ones, "0" + ones, "-0" + ones,
                                   "00" + ones + ".5", std::string("0.001e999"), "0." + ones + "e+999", ones + "e-50",
                                   std::string("1e99999999999999999999"), std::string(".5e400")}) {
    EXPECT_NE(test::input_error([&] { number_in(large); }).find("is too large for a number"), std::string::npos)
        << large;
  }
}

TEST(TextCursor, ReadsLongNumbers) {
  const std::string zeros(400, '0');
  EXPECT_EQ(number_in("0" + zeros + "12.5"), 12.5);
  EXPECT_EQ(number_in("1" + zeros + "e-400"), 1.0);
  EXPECT_EQ(number_in("0." + zeros + "25e401"), 2.5);
  EXPECT_EQ(number_in("0e999"), 0.0);
}

}  // namespace
}  // namespace spincat::io
