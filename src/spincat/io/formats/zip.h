// ZIP archives, of which NumPy's .npz and 3MF files are made. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace spincat::io {

struct ZipEntry {
  std::string_view name;
  std::uint64_t size = 0;  // unpacked, as the archive says
  std::uint64_t packed = 0;
  std::uint64_t begin = 0;  // of its own header
  std::uint32_t checksum = 0;
  unsigned method = 0;
  bool encrypted = false;
};

class ZipArchive {
 public:
  // The bytes must outlast it. Throws InputError where they are no archive, or a damaged one.
  explicit ZipArchive(std::string_view bytes);

  const std::vector<ZipEntry>& entries() const { return entries_; }

  // The entry of that name; upper and lower case are the same where no other fits. nullptr where there is none.
  const ZipEntry* find(std::string_view name) const;

  // Hands an entry on piece by piece, no more than it is said to have, until that is enough (false). Throws InputError
  // where it is damaged, encrypted or packed in a way that is not read. What it unpacks to may be a thousand times its
  // size: check_growth is the caller's.
  void unpack(const ZipEntry& entry, const std::function<bool(std::string_view)>& take) const;
  std::string unpack(const ZipEntry& entry) const;

 private:
  std::string_view packed_bytes(const ZipEntry& entry) const;
  void inflate(const ZipEntry& entry, const std::function<bool(std::string_view)>& take) const;

  std::string_view bytes_;
  std::vector<ZipEntry> entries_;
};

}  // namespace spincat::io
