#include "spincat/io/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

#include "spincat/error.h"
#include "spincat/io/file.h"
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

}  // namespace
}  // namespace spincat
