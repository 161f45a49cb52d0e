#include "spincat/files/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <future>
#include <iterator>
#include <string>

#include "spincat/error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

template <typename TableTicket, typename Action>
std::string problem_of(Action action) {
  try {
    action();
  } catch (const TableTicket& error) {
    return error.problem();
  }
  return "(nothing thrown)";
}

std::ptrdiff_t entries_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

unsigned mode_of(const fs::path& file) {
  struct stat status = {};
  ::stat(file.c_str(), &status);
  return status.st_mode & 07777U;
}

TEST(ReadFile, GivesEveryByte) {
  const test::TempDir dir;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(read_file(dir.write("file", bytes)), bytes);
  EXPECT_EQ(read_file(dir.write("empty", "")), "");
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(read_file(dir.write("large", large)), large);
}

TEST(ReadFile, ReadsAPipeToItsEnd) {
  const test::TempDir dir;
  const fs::path pipe = dir / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string large(100'000, 'x');
  auto writer = std::async(std::launch::async, [&] { write_file_atomically(pipe, large); });
  EXPECT_EQ(read_file(pipe), large);
  writer.get();
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(ReadFile, GivesNoMoreThanIsAskedFor) {
  const test::TempDir dir;
  const std::string large(10'000, 'x');
  const fs::path file = dir.write("file", large);
  EXPECT_EQ(read_file(file, 0), "");
  EXPECT_EQ(read_file(file, 9'999), large.substr(1));
  EXPECT_EQ(read_file(file, 10'000), large);
  EXPECT_EQ(read_file(file, 10'001), large);
  fs::resize_file(file, std::uintmax_t{1} << 40);  // with a hole in it
  EXPECT_EQ(read_file(file, 10'000), large);
}

// They have no end. (What the standard input is may be read: that is for the user to say.)
TEST(ReadFile, RefusesDevices) {
  const test::TempDir dir;
  fs::create_symlink("/dev/zero", dir / "zero.off");
  EXPECT_EQ(problem_of<InputError>([&] { read_file(dir / "zero.off"); }), "is a device, not a file");
  EXPECT_EQ(problem_of<InputError>([] { read_file("/dev/full", 1); }), "is a device, not a file");
  EXPECT_EQ(read_file("/dev/null"), "");
}

TEST(ReadFile, ReadsADeviceThatIsTheStandardInput) {
  const int input = ::dup(STDIN_FILENO);
  ASSERT_GE(input, 0);
  const int zero = ::open("/dev/zero", O_RDONLY);
  ASSERT_GE(::dup2(zero, STDIN_FILENO), 0);
  ::close(zero);
  EXPECT_EQ(read_file("/dev/stdin", 3), std::string(3, '\0'));
  EXPECT_EQ(problem_of<InputError>([] { read_file("/dev/full", 1); }), "is a device, not a file");
  ::dup2(input, STDIN_FILENO);
  ::close(input);
}

TEST(ReadFile, SaysWhyItCannot) {
  const test::TempDir dir;
  EXPECT_EQ(problem_of<InputError>([&] { read_file(dir / "missing"); }), "no such file");
  EXPECT_EQ(problem_of<InputError>([&] { read_file(dir.path()); }), "is a folder, not a file");
  EXPECT_EQ(problem_of<InputError>([&] { read_file(dir.write("file", "x") / "y"); }), "not a directory");
}

TEST(WriteFile, WritesNewFilesWithTheUsualMode) {
  const test::TempDir dir;
  const mode_t mask = ::umask(027);
  write_file_atomically(dir / "new", std::string("a\0b", 3));
  ::umask(mask);
  EXPECT_EQ(read_file(dir / "new"), std::string("a\0b", 3));
  EXPECT_EQ(mode_of(dir / "new"), 0640U);
  EXPECT_EQ(entries_in(dir.path()), 1);
}

TEST(WriteFile, ReplacesContentAndKeepsTheMode) {
  const test::TempDir dir;
  const fs::path file = dir.write("file", "a longer old content");
  fs::permissions(file, fs::perms(0604));
  write_file_atomically(file, "new");
  EXPECT_EQ(read_file(file), "new");
  EXPECT_EQ(mode_of(file), 0604U);
  EXPECT_EQ(entries_in(dir.path()), 1);
}

TEST(WriteFile, FollowsSymbolicLinks) {
  const test::TempDir dir;
  dir.write("folder/file", "old");
  fs::create_symlink("folder/file", dir / "link");
  fs::create_symlink("link", dir / "link-to-link");
  write_file_atomically(dir / "link-to-link", "new");
  EXPECT_EQ(read_file(dir / "folder/file"), "new");
  EXPECT_TRUE(fs::is_symlink(dir / "link"));
  EXPECT_TRUE(fs::is_symlink(dir / "link-to-link"));

  fs::create_symlink("folder/not-yet", dir / "dangling");
  write_file_atomically(dir / "dangling", "first");
  EXPECT_EQ(read_file(dir / "folder/not-yet"), "first");
}

TEST(WriteFile, NeedsAFolderAndAFileName) {
  const test::TempDir dir;
  const fs::path lost = dir / "missing/file";
  const std::string no_folder = "there is no folder '" + (dir / "missing").string() + "' to write it to";
  const std::string folder = "is a folder, so no file can be written under that name";
  EXPECT_EQ(problem_of<InputError>([&] { write_file_atomically(lost, "x"); }), no_folder);
  EXPECT_EQ(problem_of<InputError>([&] { check_writable(lost); }), no_folder);
  EXPECT_EQ(problem_of<InputError>([&] { write_file_atomically(dir.path(), "x"); }), folder);
  EXPECT_EQ(problem_of<InputError>([&] { check_writable(dir.path()); }), folder);
  EXPECT_EQ(entries_in(dir.path()), 0);
}

TEST(WriteFile, SaysThatADeviceIsFull) {
  EXPECT_EQ(problem_of<RunError>([] { write_file_atomically("/dev/full", "x"); }),
            "cannot write: no space left on device");
}

TEST(WriteFile, WritesDevicesStraight) {
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ::testing::internal::CaptureStdout();
  write_file_atomically("/dev/stdout", "to the terminal");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "to the terminal");
}

// No file may grow beyond `bytes` while this lives: writing then fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_ = {};
  void (*handler_)(int) = nullptr;
};

TEST(WriteFile, KeepsTheOldContentWhenItFails) {
  const test::TempDir dir;
  const fs::path file = dir.write("file", "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(problem_of<RunError>([&] { write_file_atomically(file, std::string(5000, 'x')); }),
              "cannot write: file too large");
  }
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(entries_in(dir.path()), 1);
}

TEST(WriteFile, RespectsWriteProtection) {
  if (::geteuid() == 0) {
    GTEST_SKIP() << "root may write everything";
  }
  const test::TempDir dir;
  const fs::path file = dir.write("file", "old");
  fs::permissions(file, fs::perms(0444));
  EXPECT_EQ(problem_of<RunError>([&] { write_file_atomically(file, "x"); }), "cannot write: permission denied");
  EXPECT_EQ(problem_of<RunError>([&] { check_writable(file); }), "cannot write: permission denied");
  EXPECT_EQ(read_file(file), "old");
}

TEST(CheckWritable, WritesNothing) {
  const test::TempDir dir;
  check_writable(dir / "new");
  check_writable("/dev/stdout");
  EXPECT_EQ(entries_in(dir.path()), 0);
  const fs::path file = dir.write("file", "old");
  check_writable(file);
  EXPECT_EQ(read_file(file), "old");
}

}  // namespace
}  // namespace spincat
