#include "spincat/io/formats/zip.h"

#include <gtest/gtest.h>

#include <string>

#include "io/zip_bytes.h"
#include "spincat/error.h"

namespace spincat::io {
namespace {

using test::little;
using test::little_row;
using test::zip;

std::string problem_of(const std::string& bytes) {
  try {
    const ZipArchive archive(bytes);
    for (const ZipEntry& entry : archive.entries()) {
      archive.unpack(entry);
    }
  } catch (const InputError& error) {
    return error.problem();
  }
  return "(nothing thrown)";
}

TEST(Zip, UnpacksItsParts) {
  const std::string large(200'000, 'x');
  for (const bool packed : {false, true}) {
    const std::string bytes = zip({{"a", "first"}, {"Folder/B", large}, {"c", ""}}, packed) + "";
    const ZipArchive archive(bytes);
    ASSERT_EQ(archive.entries().size(), 3U);
    EXPECT_EQ(archive.unpack(archive.entries()[0]), "first");
    EXPECT_EQ(archive.unpack(*archive.find("folder/b")), large);
    EXPECT_EQ(archive.unpack(*archive.find("c")), "");
    EXPECT_EQ(archive.find("d"), nullptr);
  }
}

TEST(Zip, PrefersTheNameAsItIsWritten) {
  const std::string bytes = zip({{"A", "upper"}, {"a", "lower"}});
  const ZipArchive archive(bytes);
  EXPECT_EQ(archive.unpack(*archive.find("a")), "lower");
}

TEST(Zip, EndsWhereItIsEnough) {
  const std::string bytes = zip({{"a", std::string(1'000'000, 'x')}});
  const ZipArchive archive(bytes);
  std::size_t taken = 0;
  archive.unpack(archive.entries()[0], [&](std::string_view piece) {
    taken += piece.size();
    return false;
  });
  EXPECT_GT(taken, 0U);
  EXPECT_LT(taken, 100'000U);
}

TEST(Zip, ReadsACommentAtTheEnd) {
  std::string bytes = zip({{"a", "first"}});
  bytes.replace(bytes.size() - 2, 2, little_row<std::uint16_t>(7));
  EXPECT_EQ(problem_of(bytes + "comment"), "(nothing thrown)");
}

// NumPy and others write sizes of 64 bits even where they are small.
TEST(Zip, ReadsLargeNumbers) {
  const std::string packed = "first";
  const std::string fields = little_row<std::uint16_t>(1, 16) + little_row<std::uint64_t>(5, 5);
  std::string head = test::zip_head("a", packed, packed, 0);
  head.replace(14, 8, little_row<std::uint32_t>(0xFFFFFFFF, 0xFFFFFFFF));
  head.replace(24, 2, little_row<std::uint16_t>(fields.size()));
  const std::string body = "PK\3\4" + head + "a" + fields + packed;
  const std::string list = "PK\1\2" + little_row<std::uint16_t>(45) + head + little_row<std::uint16_t>(0, 0, 0) +
                           little_row<std::uint32_t>(0, 0) + "a" + fields;
  const std::string end64 = "PK\6\6" + little_row<std::uint64_t>(44) + little_row<std::uint16_t>(45, 45) +
                            little_row<std::uint32_t>(0, 0) + little_row<std::uint64_t>(1, 1, list.size(), body.size());
  const std::string locator = "PK\6\7" + little_row<std::uint32_t>(0) +
                              little_row<std::uint64_t>(body.size() + list.size()) + little_row<std::uint32_t>(1);
  const std::string end = "PK\5\6" + little_row<std::uint16_t>(0, 0, 0xFFFF, 0xFFFF) +
                          little_row<std::uint32_t>(0xFFFFFFFF, 0xFFFFFFFF) + little_row<std::uint16_t>(0);
  const std::string bytes = body + list + end64 + locator + end;
  const ZipArchive archive(bytes);
  ASSERT_EQ(archive.entries().size(), 1U);
  EXPECT_EQ(archive.unpack(archive.entries()[0]), "first");
}

TEST(Zip, RefusesInWords) {
  EXPECT_EQ(problem_of(""), "is no ZIP archive, or is cut off");
  const std::string good = zip({{"a", "first and second"}});
  EXPECT_EQ(problem_of(good.substr(0, good.size() - 1)), "is no ZIP archive, or is cut off");
  std::string bad = good;
  const std::size_t list = bad.find("PK\1\2");
  bad[list + 10] = 12;
  EXPECT_EQ(problem_of(bad), "its part 'a' is packed by method 12; spincat reads stored and deflated parts");
  bad = good;
  bad[list + 8] = 1;
  EXPECT_EQ(problem_of(bad), "its part 'a' is encrypted");
  bad = good;
  bad[list + 16] ^= 1;
  EXPECT_EQ(problem_of(bad), "its part 'a' is damaged");
  bad = good;
  bad[list + 24] -= 1;  // more than it says
  EXPECT_EQ(problem_of(bad), "its part 'a' is damaged");
  bad = good;
  bad[list + 43] = 1;  // its place
  EXPECT_EQ(problem_of(bad), "is a damaged ZIP archive");
  bad = good;
  bad[bad.size() - 3] = 1;  // the place of the list
  EXPECT_EQ(problem_of(bad), "is a damaged ZIP archive");
}

}  // namespace
}  // namespace spincat::io
