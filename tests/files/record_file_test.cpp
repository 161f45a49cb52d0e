#include "spincat/files/record_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "support/expect_error.h"
#include "support/record_bytes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using nlohmann::json;
using namespace std::string_literals;

json small_content() {
  return {{"categories", {"chair", "st\xFChle"}},
          {"bin", 0.1},
          {"seed", 18446744073709551615U},
          {"offset", -7},
          {"weights", json::binary({0, 255, 26, 10, 13})},
          {"nothing", nullptr},
          {"flag", true}};
}

std::string error_of(std::string_view bytes, std::string_view kind = "model", std::uint32_t newest = 2) {
  try {
    unpack_record(bytes, kind, newest);
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "");
    return error.what();
  }
  return "no error";
}

template <class T>
std::string little_endian(T value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  }
  return bytes;
}

// A record that is right in everything but, maybe, its payload.
std::string record_of(std::string_view payload) {
  std::string bytes = "SPINCAT\x1A"s + "\5\0\0\0model"s + "\1\0\0\0"s;
  bytes += little_endian(static_cast<std::uint64_t>(payload.size()));
  bytes += payload;
  return bytes + little_endian(static_cast<std::uint32_t>(
                     crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size())));
}

TEST(RecordFile, GivesBackWhatWasPacked) {
  for (const json& content : {small_content(), json::object(), json(), json("text"), json::array({json::array()})}) {
    const std::string bytes = test::record_bytes("model", 2, content);
    EXPECT_EQ(unpack_record(bytes, "model", 2), content);
    EXPECT_EQ(test::record_bytes("model", 2, unpack_record(bytes, "model", 3)), bytes);
  }
}

TEST(RecordFile, HasTheDocumentedLayout) {
  EXPECT_EQ(test::record_bytes("model", 1, json{{"a", json::binary({1, 2})}}), record_of("\xA1\x61\x61\x42\x01\x02"));
}

TEST(RecordFile, KeepsLargeBlobs) {
  std::vector<std::uint8_t> blob(300'000);
  for (std::size_t i = 0; i < blob.size(); ++i) {
    blob[i] = static_cast<std::uint8_t>(i * 7);
  }
  const json content = {{"blob", json::binary(blob)}};
  EXPECT_EQ(unpack_record(test::record_bytes("model", 1, content), "model", 1), content);
}

// Those that stay where they are: the lengths need 0, 1, 2 and 4 bytes of their own.
TEST(RecordFile, WritesBlobsFromWhereTheyAre) {
  const test::TempDir dir;
  for (const std::size_t count : {0, 5, 6, 63, 64, 16'383, 16'384, 5'000'000}) {
    std::vector<float> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      numbers[i] = static_cast<float>(i) / 7.0F;
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(numbers.data());
    RecordBlobs blobs;
    const json linked = {{"a", {{"blob", blobs.add(numbers)}, {"n", count}, {"list", {1, 2, "three"}}}},
                         {"again", blobs.add(numbers)},
                         {"small", json::binary({1, 2, 3})}};
    json copied = linked;
    copied["a"]["blob"] = json::binary({bytes, bytes + numbers.size() * sizeof(float)});
    copied["again"] = copied["a"]["blob"];
    write_record(dir / "linked", "model", 1, linked, blobs);
    EXPECT_TRUE(read_file(dir / "linked") == test::record_bytes("model", 1, copied)) << count;
  }
}

TEST(RecordFile, WritesObjectsOfManyMembersAsTheLibraryDoes) {
  json content;
  for (int i = 0; i < 300; ++i) {
    content["m" + std::to_string(i)] = i;
    const std::string bytes = test::record_bytes("model", 1, content);
    const std::vector<std::uint8_t> cbor = json::to_cbor(content);
    ASSERT_EQ(bytes, record_of({reinterpret_cast<const char*>(cbor.data()), cbor.size()})) << i;
  }
}

TEST(RecordFile, WritesWhatItPacks) {
  const test::TempDir dir;
  const auto file = dir.write("record", "old");
  json content = small_content();
  EXPECT_THROW(write_record(file, "a kind", 1, content), InputError);
  EXPECT_EQ(read_file(file), "old");
  content["blob"] = json::binary(std::vector<std::uint8_t>(20'000'000, 7));
  write_record(file, "model", 2, content);
  EXPECT_TRUE(unpack_record(read_file(file), "model", 2) == content);
}

TEST(RecordFile, RefusesEveryDamagedByte) {
  const std::string good = test::record_bytes("model", 2, small_content());
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int change = 1; change < 256; ++change) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ change);
      ASSERT_NE(error_of(bad), "no error") << "byte " << i << " changed by " << change;
    }
  }
}

TEST(RecordFile, RefusesEveryTruncation) {
  const std::string good = test::record_bytes("model", 2, small_content());
  for (std::size_t size = 0; size < good.size(); ++size) {
    const std::string error = error_of(good.substr(0, size));
    ASSERT_EQ(error.substr(0, 12), size < 8 ? "is not a spi" : "is truncated") << size;
  }
}

TEST(RecordFile, NamesWhatIsWrong) {
  const std::string good = test::record_bytes("model", 2, small_content());
  const std::string size = std::to_string(good.size());
  EXPECT_EQ(error_of("OFF\n8 6 12\n"), "is not a spincat file");
  EXPECT_EQ(error_of(test::record_bytes("journal", 9, 1)), "is a spincat journal, not a model");
  EXPECT_EQ(error_of(good.substr(0, good.size() - 1)),
            "is truncated: expected " + size + " bytes, has " + std::to_string(good.size() - 1));
  EXPECT_EQ(error_of(good + "\n"), "is too long: expected " + size + " bytes, has " + std::to_string(good.size() + 1));
  std::string damaged = good;
  damaged[40] ^= 1;
  EXPECT_EQ(error_of(damaged), "is damaged: its checksum does not match");
}

TEST(RecordFile, NamesANewerVersionBeforeAnythingBehindIt) {
  std::string newer = test::record_bytes("model", 3, small_content());
  const std::string message = "was written by a newer spincat (model format 3, this one reads up to 2)";
  EXPECT_EQ(error_of(newer), message);
  newer.back() ^= 1;
  EXPECT_EQ(error_of(newer), message);
  EXPECT_EQ(error_of(newer.substr(0, newer.size() - 3)), message);
}

TEST(RecordFile, NamesAnOlderVersion) {
  const std::string old = test::record_bytes("model", 1, small_content());
  EXPECT_EQ(unpack_record(old, "model", 3, 1), small_content());
  EXPECT_EQ(test::input_error([&] { unpack_record(old, "model", 3, 2); }),
            "was written by an older spincat (model format 1, this one reads from 2 on)");
}

// A byte for each number, sixteen in memory, and three times that while the list grows.
TEST(RecordFile, RefusesContentThatIsFarLargerInMemory) {
  const json list = json(std::vector<int>(1'000'000, 1));
  EXPECT_THROW(test::record_bytes("model", 1, list), InputError);
  const std::string zeros = "\x9A\x00\x0F\x42\x40"s + std::string(1'000'000, '\0');
  EXPECT_EQ(error_of(record_of(zeros)), "is damaged: its content would take 48000112 bytes of memory");
  EXPECT_EQ(unpack_record(test::record_bytes("model", 1, json(std::vector<int>(100'000, 1))), "model", 1).size(),
            100'000U);
}

TEST(RecordFile, RefusesLengthsThatCannotBe) {
  const std::string header = "SPINCAT\x1A"s + "\5\0\0\0model"s + "\1\0\0\0"s;
  EXPECT_EQ(error_of(header + std::string(8, '\xFF')), "is truncated: expected 18446744073709551615 bytes, has 29");
  EXPECT_EQ(error_of("SPINCAT\x1A\xFF\xFF\xFF\xFFmodel"), "is damaged: its kind is unreadable");
  EXPECT_EQ(error_of("SPINCAT\x1A\5\0\0\0m\nd\0l"s), "is damaged: its kind is unreadable");
}

TEST(RecordFile, NestsThirtyTwoDeepAndNoDeeper) {
  json content = 1;
  for (int i = 0; i < 32; ++i) {
    content = json::array({std::move(content)});
  }
  EXPECT_EQ(unpack_record(test::record_bytes("model", 1, content), "model", 1), content);
  EXPECT_THROW(test::record_bytes("model", 1, json::array({content})), InputError);
}

TEST(RecordFile, WhatCborCannotSayPlainlyIsNotWritten) {
  EXPECT_THROW(test::record_bytes("model", 1, {{"a", json::binary({1, 2}, 7)}}), InputError);
  EXPECT_THROW(test::record_bytes("model", 1, json::array({json(json::value_t::discarded)})), InputError);
}

TEST(RecordFile, RefusesDeepNesting) {
  const std::string message = "is damaged: its content is nested more than 32 deep";
  constexpr std::size_t kDeep = 5'000'000;
  EXPECT_EQ(error_of(record_of(std::string(kDeep, '\x81') + "\1")), message);
  std::string maps;
  for (std::size_t i = 0; i < kDeep / 2; ++i) {
    maps += "\xA1\x60";
  }
  EXPECT_EQ(error_of(record_of(maps + "\1")), message);
}

// nlohmann's parser recurses into these without telling its SAX handler.
TEST(RecordFile, RefusesChunkedStringsAndTagsHoweverDeep) {
  constexpr std::size_t kDeep = 5'000'000;
  for (const char head : {'\x7F', '\x5F', '\x9F', '\xBF', '\xC0', '\xD8'}) {
    EXPECT_EQ(error_of(record_of(std::string(kDeep, head))), "is damaged: its content is not valid CBOR");
  }
}

TEST(RecordFile, RefusesCborThatIsNotValid) {
  const auto message = [](std::string_view payload) { return error_of(record_of(payload)).substr(0, 42); };
  const std::string invalid = "is damaged: its content is not valid CBOR";
  for (const std::string& payload : {""s, "\x82\1"s, "\1\1"s,
                                     "\x63"
                                     "ab"s,
                                     "\x9B\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s, "\xBB\x80\0\0\0\0\0\0\0\0"s,
                                     "\x7B\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s, "\x1C"s, "\x19\1"s, "\xFF"s}) {
    EXPECT_EQ(message(payload), invalid);
  }
  // Well-formed, but not what JSON has: "undefined", and a map whose key is a number.
  EXPECT_EQ(message("\xF7"), invalid + " ");
  EXPECT_EQ(message("\xA1\1\1"), invalid + " ");
}

}  // namespace
}  // namespace spincat
