// Whole files in and out: read at once, written beside and renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace spincat {

// The whole file as bytes, or no more than its first `most`. Pipes are read to their end, and so is whatever device the
// standard input is; other devices, which may have no end, are refused (but for /dev/null). Throws InputError when it
// does not exist, is a folder or such a device, or cannot be read.
std::string read_file(const std::filesystem::path& file, std::size_t most = std::numeric_limits<std::size_t>::max());

// Writes `bytes` to a temporary file in the same folder, flushes it to the disk and renames it to `file`, so that
// `file` holds either what it held before or everything. A symbolic link is followed; /dev/stdout and pipes are written
// straight. An existing file keeps its permissions, and one that is write-protected is not replaced. The temporary file
// is removed on failure.
// Throws InputError when the folder does not exist or `file` is a folder, RunError when writing fails (disk full, ...).
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// Throws exactly as write_file_atomically would when its folder is missing or not writable, without writing anything:
// for refusing before hours of work, not after.
void check_writable(const std::filesystem::path& file);

}  // namespace spincat
