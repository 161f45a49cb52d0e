// A file that is written piece by piece and appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace spincat {

// Writes to a temporary file in the folder of `file`; commit() flushes it to the disk and renames it to `file`. Without
// commit() nothing is left behind and `file` stays what it was. Otherwise as write_file_atomically (file.h): links are
// followed, devices and pipes are written straight, an existing file keeps its permissions.
//
//   OutputFile out("images.npy");
//   out.write(header);
//   out.write(block);
//   out.commit();
class OutputFile {
 public:
  // Throws InputError when the folder does not exist or `file` is a folder, RunError when it cannot be written to.
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throw RunError when writing fails (disk full, ...). A large piece goes past the system's cache of files.
  void write(std::string_view bytes);
  void commit();

 private:
  void write_all(std::string_view bytes);
  std::size_t write_past_cache(std::string_view bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path file_;       // as the user named it
  std::filesystem::path target_;     // where links lead to
  std::filesystem::path temporary_;  // empty when written straight, or when committed
  int descriptor_ = -1;
  std::uint64_t written_ = 0;  // bytes
};

}  // namespace spincat
