#include "spincat/parallel/journal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <vector>

#include "spincat/error.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

const RunIdentity kRun{"train --seed 1", "3 files"};

class JournalTest : public testing::Test {
 protected:
  fs::path file() const { return dir_.path() / "run.journal"; }
  test::TempDir dir_;
};

TEST_F(JournalTest, KeepsResultsFromRunToRun) {
  {
    Journal journal(file(), kRun);
    EXPECT_EQ(journal.size(), 0U);
    journal.add(0, 7, "seven");
    journal.add(1, 7, "");
    EXPECT_EQ(journal.find(0, 7), "seven");
  }
  Journal journal(file(), kRun);
  EXPECT_EQ(journal.size(), 2U);
  EXPECT_EQ(journal.find(0, 7), "seven");
  EXPECT_EQ(journal.find(1, 7), "");
  EXPECT_EQ(journal.find(1, 8), std::nullopt);
  journal.remove();
  EXPECT_FALSE(fs::exists(file()));
}

// Whatever the moment at which the writer was killed: whole records are there, and more can be added.
TEST_F(JournalTest, AnyTornEndIsCutOff) {
  std::vector<std::uintmax_t> ends;
  {
    Journal journal(file(), kRun);
    ends.push_back(fs::file_size(file()));
    for (int task = 0; task < 3; ++task) {
      journal.add(0, static_cast<std::uint64_t>(task), std::string(5 + task, 'x'));
      ends.push_back(fs::file_size(file()));
    }
  }
  const fs::path whole = dir_.path() / "whole";
  fs::copy_file(file(), whole);
  for (std::uintmax_t size = 0; size <= ends.back(); ++size) {
    fs::copy_file(whole, file(), fs::copy_options::overwrite_existing);
    fs::resize_file(file(), size);
    std::size_t expected = 0;
    while (expected < 3 && ends[expected + 1] <= size) {
      ++expected;
    }
    Journal journal(file(), kRun);
    EXPECT_EQ(journal.size(), expected) << size;
    journal.add(9, 9, "after");
    EXPECT_EQ(journal.find(9, 9), "after");
  }
}

TEST_F(JournalTest, ADamagedRecordEndsIt) {
  std::uintmax_t first_end = 0;
  {
    Journal journal(file(), kRun);
    journal.add(0, 0, "first");
    first_end = fs::file_size(file());
    journal.add(0, 1, "second");
  }
  {
    std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(first_end + 26));
    stream.put('!');
  }
  const Journal journal(file(), kRun);
  EXPECT_EQ(journal.size(), 1U);
  EXPECT_EQ(fs::file_size(file()), first_end);
}

TEST_F(JournalTest, RefusesOtherRunsAndOtherFiles) {
  { Journal(file(), kRun).add(0, 0, "x"); }
  test::expect_error<InputError>([&] { Journal(file(), {"train --seed 2", "3 files"}); }, "other settings");
  test::expect_error<InputError>([&] { Journal(file(), {"train --seed 1", "4 files"}); }, "other data");
  dir_.write("notes.txt", "these are the user's notes, and they are longer than the head of a journal would be: keep");
  test::expect_error<InputError>([&] { Journal(dir_.path() / "notes.txt", kRun); }, "is no journal of spincat");
  dir_.write("short.txt", "notes");
  test::expect_error<InputError>([&] { Journal(dir_.path() / "short.txt", kRun); }, "is no journal of spincat");
  EXPECT_EQ(Journal(file(), kRun).size(), 1U);  // refusing has changed nothing
  test::expect_error<RunError>([&] { Journal(dir_.path() / "no" / "folder", kRun); }, "cannot write: no such file");
}

TEST_F(JournalTest, TwoRunsDoNotShareOne) {
  const Journal journal(file(), kRun);
  test::expect_error<RunError>([&] { Journal(file(), kRun); }, "is in use by another run");
}

TEST(FilesIdentity, NoticesAnotherNameSizeOrTime) {
  const test::TempDir dir;
  dir.write("a", "1");
  const auto identity = [&](const char* name) {
    FilesIdentity files;
    files.add(dir.path() / name);
    return files.text();
  };
  const std::string before = identity("a");
  EXPECT_EQ(before, identity("a"));
  EXPECT_NE(before, identity("b"));
  dir.write("a", "12");
  const std::string longer = identity("a");
  EXPECT_NE(before, longer);
  fs::last_write_time(dir.path() / "a", fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_NE(longer, identity("a"));
}

TEST(FilesIdentity, NoticesAnotherBufferOfAGltfFile) {
  const test::TempDir dir;
  dir.write("a.gltf", "{}");
  dir.write("b.off", "OFF");
  dir.write("a.bin", "1");
  const auto identity = [&](const char* name) {
    FilesIdentity files;
    files.add(dir.path() / name);
    files.add(dir.path() / name);
    return files.text();
  };
  const std::string gltf = identity("a.gltf");
  const std::string off = identity("b.off");
  EXPECT_EQ(gltf.substr(0, 7), "2 files");
  dir.write("a.journal", "something that the run itself writes");
  EXPECT_EQ(identity("a.gltf"), gltf);
  dir.write("a.bin", "12");
  EXPECT_NE(identity("a.gltf"), gltf);
  EXPECT_EQ(identity("b.off"), off);
}

}  // namespace
}  // namespace spincat
