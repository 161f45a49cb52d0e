// The seeds of the fuzz program and whatever it ever found, fed to the readers once more.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/readers.h"
#include "spincat/files/file.h"

namespace spincat::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

// What is read in two ways is refused in one of them, and the objects that a list names are not there.
const std::vector<const char*> kByNature = {"is no ZIP archive",
                                            "no valid XML",
                                            "holds no array that is a cloud",
                                            "make up no picture",
                                            "the header line names no column",
                                            "no object is left",
                                            "is not a spincat file",
                                            "its content is not valid CBOR",
                                            "is no journal of spincat",
                                            "is no journal of a sweep",
                                            "is the journal of an older spincat",
                                            "it's no PNG or corrupted",
                                            "smaller than a PNG header",
                                            "illegal bit depth for this color type",
                                            "zlib header"};

// By these folders scripts/fuzz and CMake know the readers.
TEST(Fuzz, EachReaderHasSeeds) {
  std::vector<std::string> names;
  for (const fs::path& folder : files_in(fs::path(SPINCAT_SOURCE_DIR) / "tests/fuzz/seeds")) {
    names.push_back(folder.filename().string());
  }
  std::vector<std::string> readers = reader_names();
  std::ranges::sort(readers);
  EXPECT_EQ(names, readers);
  for (const fs::path& folder : files_in(fs::path(SPINCAT_SOURCE_DIR) / "tests/fuzz/found")) {
    EXPECT_TRUE(std::ranges::binary_search(readers, folder.filename().string())) << folder;
  }
}

class Fuzzed : public testing::TestWithParam<std::string> {
 protected:
  static std::vector<fs::path> kept(const char* kind) {
    return files_in(fs::path(SPINCAT_SOURCE_DIR) / "tests/fuzz" / kind / GetParam());
  }
};

TEST_P(Fuzzed, SeedsAreReadToTheEnd) {
  const std::vector<fs::path> seeds = kept("seeds");
  EXPECT_GE(seeds.size(), 2U);
  for (const fs::path& seed : seeds) {
    for (const std::string& refusal : read_as(GetParam(), read_file(seed))) {
      EXPECT_TRUE(std::ranges::any_of(kByNature, [&](const char* text) { return refusal.find(text) != refusal.npos; }))
          << seed << ": " << refusal;
    }
  }
}

// read_as throws where a promise is broken.
TEST_P(Fuzzed, WhatWasFoundIsReadOrRefusedInALine) {
  for (const fs::path& found : kept("found")) {
    EXPECT_NO_THROW(read_as(GetParam(), read_file(found))) << found;
  }
}

TEST_P(Fuzzed, EveryTruncationOfASeedIsReadOrRefusedInALine) {
  for (const fs::path& seed : kept("seeds")) {
    const std::string bytes = read_file(seed);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_NO_THROW(read_as(GetParam(), bytes.substr(0, size))) << seed << " cut to " << size;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzzed, testing::ValuesIn(reader_names()),
                         [](const auto& reader) { return reader.param; });

}  // namespace
}  // namespace spincat::test
