#include "spincat/files/output_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(OutputFile, AppearsWholeAtTheCommit) {
  const test::TempDir dir;
  const auto file = dir.write("a.npy", "old");
  OutputFile out(file);
  out.write("new, ");
  out.write("in pieces");
  EXPECT_EQ(read_file(file), "old");
  out.commit();
  EXPECT_EQ(read_file(file), "new, in pieces");
  EXPECT_EQ(files_in(dir.path()), 1);
}

TEST(OutputFile, LeavesNothingWithoutACommit) {
  const test::TempDir dir;
  {
    OutputFile out(dir / "a.npy");
    out.write("half");
    EXPECT_EQ(files_in(dir.path()), 1);
  }
  EXPECT_EQ(files_in(dir.path()), 0);
}

TEST(OutputFile, TellsAFullDiskWhereItHappens) {
  OutputFile out("/dev/full");
  EXPECT_THROW(out.write("x"), RunError);
}

// Another process with half a result in `folder`, which waits until it is killed.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder) {
    int ready[2];
    if (::pipe(ready) != 0) {
      return;
    }
    process_ = ::fork();
    if (process_ == 0) {
      OutputFile out(folder / "result");
      out.write("half");
      if (::write(ready[1], "x", 1) == 1) {
        ::pause();
      }
      ::_exit(1);
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Writer() { end(); }

  void end() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
      process_ = -1;
    }
  }

 private:
  pid_t process_ = -1;
};

TEST(OutputFile, RemovesWhatAKilledProcessLeft) {
  const test::TempDir dir;
  Writer(dir.path()).end();
  ASSERT_EQ(files_in(dir.path()), 1);
  write_file_atomically(dir / "result", "whole");
  EXPECT_EQ(files_in(dir.path()), 1);
  EXPECT_EQ(read_file(dir / "result"), "whole");
}

TEST(OutputFile, LeavesTheFilesOfLivingProcessesAndOfOtherHostsAlone) {
  const test::TempDir dir;
  const Writer other(dir.path());
  dir.write(".spincat-another.host-1-0.tmp", "half");
  write_file_atomically(dir / "result", "whole");
  EXPECT_EQ(files_in(dir.path()), 3);
}

}  // namespace
}  // namespace spincat
