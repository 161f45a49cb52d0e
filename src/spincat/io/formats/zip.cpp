#include "spincat/io/formats/zip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <new>

#include "spincat/error.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

// Sizes of the records, before names and the like.
constexpr std::size_t kEnd = 22, kEnd64 = 56, kLocator64 = 20, kInList = 46, kBeforeData = 30;

std::uint64_t number16(std::string_view bytes, std::size_t at) {
  return load<std::uint16_t>(bytes.data() + at);
}
std::uint64_t number32(std::string_view bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at);
}
std::uint64_t number64(std::string_view bytes, std::size_t at) {
  return load<std::uint64_t>(bytes.data() + at);
}

[[noreturn]] void fail() {
  throw InputError("is a damaged ZIP archive");
}

struct List {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;
};

// Where the list of entries is, by the record at the end; a comment may follow that.
List find_list(std::string_view bytes) {
  constexpr std::size_t kLongestComment = 0xFFFF;
  const std::size_t from = bytes.size() > kEnd + kLongestComment ? bytes.size() - kEnd - kLongestComment : 0;
  const std::size_t at = bytes.substr(from).rfind("PK\5\6") + from;
  if (bytes.substr(from).rfind("PK\5\6") == std::string_view::npos || bytes.size() - at < kEnd) {
    throw InputError("is no ZIP archive, or is cut off");
  }
  const List list{number32(bytes, at + 16), number32(bytes, at + 12)};
  // Large archives say it in another record, which one right before this names.
  if (at < kLocator64 || bytes.substr(at - kLocator64, 4) != "PK\6\7") {
    return list;
  }
  const std::uint64_t at64 = number64(bytes, at - kLocator64 + 8);
  if (at64 > bytes.size() || bytes.size() - at64 < kEnd64 || bytes.substr(at64, 4) != "PK\6\6") {
    fail();
  }
  return {number64(bytes, at64 + 48), number64(bytes, at64 + 40)};
}

// Numbers that did not fit into 32 bits stand in a field of their own, in this order and only those.
void read_large_numbers(std::string_view fields, ZipEntry& entry) {
  constexpr std::uint64_t kElsewhere = 0xFFFFFFFF, kKind = 1;
  while (fields.size() >= 4) {
    const std::uint64_t kind = number16(fields, 0);
    std::string_view field = fields.substr(4, number16(fields, 2));
    fields.remove_prefix(4 + field.size());
    for (std::uint64_t* number : {&entry.size, &entry.packed, &entry.begin}) {
      if (kind == kKind && *number == kElsewhere && field.size() >= 8) {
        *number = number64(field, 0);
        field.remove_prefix(8);
      }
    }
  }
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  const List list = find_list(bytes);
  if (list.begin > bytes.size() || list.size > bytes.size() - list.begin) {
    fail();
  }
  std::string_view rest = bytes.substr(list.begin, list.size);
  while (rest.size() >= kInList && rest.starts_with("PK\1\2")) {
    const std::uint64_t name = number16(rest, 28), fields = number16(rest, 30), comment = number16(rest, 32);
    if (name + fields + comment > rest.size() - kInList) {
      fail();
    }
    ZipEntry entry;
    entry.name = rest.substr(kInList, name);
    entry.encrypted = (number16(rest, 8) & 1U) != 0;
    entry.method = static_cast<unsigned>(number16(rest, 10));
    entry.checksum = static_cast<std::uint32_t>(number32(rest, 16));
    entry.packed = number32(rest, 20);
    entry.size = number32(rest, 24);
    entry.begin = number32(rest, 42);
    read_large_numbers(rest.substr(kInList + name, fields), entry);
    entries_.push_back(entry);
    rest.remove_prefix(kInList + name + fields + comment);
  }
}

const ZipEntry* ZipArchive::find(std::string_view name) const {
  auto found = std::ranges::find(entries_, name, &ZipEntry::name);
  if (found == entries_.end()) {
    found = std::ranges::find_if(entries_, [&](const ZipEntry& entry) { return same_letters(entry.name, name); });
  }
  return found == entries_.end() ? nullptr : &*found;
}

std::string_view ZipArchive::packed_bytes(const ZipEntry& entry) const {
  if (entry.begin > bytes_.size() || bytes_.size() - entry.begin < kBeforeData ||
      bytes_.substr(entry.begin, 4) != "PK\3\4") {
    fail();
  }
  const std::uint64_t begin =
      entry.begin + kBeforeData + number16(bytes_, entry.begin + 26) + number16(bytes_, entry.begin + 28);
  if (begin > bytes_.size() || entry.packed > bytes_.size() - begin) {
    fail();
  }
  return bytes_.substr(begin, entry.packed);
}

void ZipArchive::unpack(const ZipEntry& entry, const std::function<bool(std::string_view)>& take) const {
  constexpr unsigned kStored = 0, kDeflated = 8;
  if (entry.encrypted) {
    throw InputError(fmt::format("its part {} is encrypted", in_quotes(entry.name)));
  }
  if (entry.method != kStored && entry.method != kDeflated) {
    throw InputError(fmt::format("its part {} is packed by method {}; spincat reads stored and deflated parts",
                                 in_quotes(entry.name), entry.method));
  }
  uLong checksum = crc32_z(0, nullptr, 0);
  std::uint64_t size = 0;
  bool is_enough = false;
  const auto check = [&](std::string_view piece) {
    size += piece.size();
    checksum = crc32_z(checksum, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
    if (size > entry.size) {
      throw InputError(fmt::format("its part {} is damaged", in_quotes(entry.name)));
    }
    is_enough = !take(piece);
    return !is_enough;
  };
  if (entry.method == kStored) {
    check(packed_bytes(entry));
  } else {
    inflate(entry, check);
  }
  if (!is_enough && (size != entry.size || checksum != entry.checksum)) {
    throw InputError(fmt::format("its part {} is damaged", in_quotes(entry.name)));
  }
}

void ZipArchive::inflate(const ZipEntry& entry, const std::function<bool(std::string_view)>& take) const {
  constexpr std::size_t kMostAtOnce = 1 << 30;  // what zlib's counters hold
  std::string_view packed = packed_bytes(entry);
  struct Stream : z_stream {
    Stream() : z_stream{} {
      if (inflateInit2(this, -MAX_WBITS) != Z_OK) {
        throw std::bad_alloc();
      }
    }
    ~Stream() { inflateEnd(this); }
  } stream;
  std::array<char, 1 << 16> out{};
  int state = Z_OK;
  while (state == Z_OK) {
    if (stream.avail_in == 0) {
      const std::string_view next = packed.substr(0, kMostAtOnce);
      packed.remove_prefix(next.size());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
      stream.avail_in = static_cast<uInt>(next.size());
    }
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    if (!take({out.data(), out.size() - stream.avail_out})) {
      return;
    }
  }
  if (state != Z_STREAM_END) {
    throw InputError(fmt::format("its part {} is damaged", in_quotes(entry.name)));
  }
}

std::string ZipArchive::unpack(const ZipEntry& entry) const {
  std::string all;
  unpack(entry, [&](std::string_view piece) {
    all += piece;
    return true;
  });
  return all;
}

}  // namespace spincat::io
