#include "spincat/io/record_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "spincat/error.h"
#include "spincat/io/magic.h"

namespace spincat {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestKind = 32;
constexpr std::size_t kDeepest = 32;
constexpr std::size_t kChecksumBytes = 4;

template <class T>
void append_little_endian(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  }
}

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

bool is_kind(std::string_view text) {
  return !text.empty() && text.size() <= kLongestKind &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

// Takes a record apart from its front.
class RecordReader {
 public:
  explicit RecordReader(std::string_view bytes) : bytes_(bytes) {}

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_) {
      throw InputError(fmt::format("is truncated: expected at least {} bytes, has {}", at_ + count, bytes_.size()));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  template <class T>
  T take_little_endian() {
    T value = 0;
    const std::string_view bytes = take(sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i));
    }
    return value;
  }

  std::string_view taken() const { return bytes_.substr(0, at_); }
  std::size_t bytes_left() const { return bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// Looks through CBOR, without recursion, for what to_cbor never writes: containers nested too deep, and strings or
// containers of no stated length; and for content that would take far more memory than its bytes, as a million empty
// lists would. nlohmann's parser recurses for each level of both, and in strings it does so without
// asking its SAX handler, so that a handler alone cannot keep 50,000 levels from overflowing the stack.
class CborCheck {
 public:
  explicit CborCheck(std::string_view bytes) : bytes_(bytes) {}

  void run() {
    constexpr std::uint64_t kFree = 8'000'000;
    constexpr std::uint64_t kMostGrowth = 12;  // the blobs come on top of it
    look_through();
    if (memory_ > kFree + kMostGrowth * bytes_.size()) {
      throw InputError(fmt::format("is damaged: its content would take {} bytes of memory", memory_));
    }
  }

 private:
  void look_through() {
    std::array<std::uint64_t, kDeepest + 1> items_left = {1};  // by level; level 0 is the content itself
    std::size_t level = 0;
    while (true) {
      while (items_left[level] == 0) {
        if (level-- == 0) {
          return check(at_ == bytes_.size());
        }
      }
      --items_left[level];
      if (const std::uint64_t inside = take_item(); inside > 0) {
        if (level == kDeepest) {
          throw InputError(fmt::format("is damaged: its content is nested more than {} deep", kDeepest));
        }
        items_left[++level] = inside;
      }
    }
  }

  static void check(bool holds) {
    if (!holds) {
      throw InputError("is damaged: its content is not valid CBOR");
    }
  }

  // Takes an item's head, and its bytes where it is a string or blob. Returns how many items it is to hold.
  std::uint64_t take_item() {
    check(at_ < bytes_.size());
    const auto head = static_cast<unsigned char>(bytes_[at_++]);
    const std::uint64_t argument = take_argument(head & 0x1F);
    constexpr std::uint64_t kInList = 3 * sizeof(json);  // the list holds its old and its new memory while it grows
    constexpr std::uint64_t kOnHeap = 64;
    memory_ += kInList + (head >> 5 >= 2 && head >> 5 <= 5 ? kOnHeap : 0);
    switch (head >> 5) {
      case 2:  // blob
      case 3:  // text
        check(argument <= bytes_.size() - at_);
        at_ += argument;
        return 0;
      case 4:  // array
        return checked_items(argument, 1);
      case 5:  // map
        return checked_items(argument, 2);
      case 6:  // tag
        check(false);
        return 0;
      default:  // a number, or true, false, null
        return 0;
    }
  }

  // The number in an item's head: itself up to 23, else in the 1, 2, 4 or 8 bytes that follow, big-endian. 28 to 30
  // mean nothing, 31 is "until further notice".
  std::uint64_t take_argument(unsigned code) {
    if (code < 24) {
      return code;
    }
    check(code < 28);
    const std::size_t count = std::size_t{1} << (code - 24);
    check(count <= bytes_.size() - at_);
    std::uint64_t argument = 0;
    for (std::size_t i = 0; i < count; ++i) {
      argument = argument << 8 | static_cast<unsigned char>(bytes_[at_++]);
    }
    return argument;
  }

  // Each item takes a byte at least, which also keeps the product from overflowing.
  std::uint64_t checked_items(std::uint64_t count, std::uint64_t items_each) const {
    check(count <= (bytes_.size() - at_) / items_each);
    return count * items_each;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t memory_ = 0;  // what nlohmann's parser will take, but for what is in strings and blobs
};

void check_kind(RecordReader& reader, std::string_view kind) {
  const auto length = reader.take_little_endian<std::uint32_t>();
  const std::string_view found = length <= kLongestKind ? reader.take(length) : std::string_view();
  if (!is_kind(found)) {
    throw InputError("is damaged: its kind is unreadable");
  }
  if (found != kind) {
    throw InputError(fmt::format("is a spincat {}, not a {}", found, kind));
  }
}

void check_version(RecordReader& reader, std::string_view kind, std::uint32_t newest_version,
                   std::uint32_t oldest_version) {
  const auto version = reader.take_little_endian<std::uint32_t>();
  if (version > newest_version) {
    throw InputError(fmt::format("was written by a newer spincat ({} format {}, this one reads up to {})", kind,
                                 version, newest_version));
  }
  if (version < oldest_version) {
    throw InputError(fmt::format("was written by an older spincat ({} format {}, this one reads from {} on)", kind,
                                 version, oldest_version));
  }
}

// Returns the length of the content.
std::size_t check_length(RecordReader& reader) {
  const auto length = reader.take_little_endian<std::uint64_t>();
  const std::size_t before = reader.taken().size();
  const std::size_t left = reader.bytes_left();
  if (left < kChecksumBytes || left - kChecksumBytes != length) {
    const std::uint64_t most = UINT64_MAX - before - kChecksumBytes;
    throw InputError(fmt::format("is {}: expected {} bytes, has {}",
                                 left < kChecksumBytes || left - kChecksumBytes < length ? "truncated" : "too long",
                                 before + std::min(length, most) + kChecksumBytes, before + left));
  }
  return length;
}

// Of all binary blobs in it: nearly all of a large record.
std::size_t blob_bytes(const json& content) {
  if (content.is_binary()) {
    return content.get_binary().size();
  }
  std::size_t sum = 0;
  for (const json& member : content) {
    sum += member.is_structured() || member.is_binary() ? blob_bytes(member) : 0;
  }
  return sum;
}

}  // namespace

std::string pack_record(std::string_view kind, std::uint32_t version, const json& content) {
  if (!is_kind(kind)) {
    throw InputError(fmt::format("a kind of record is up to {} letters from a to z", kLongestKind));
  }
  constexpr std::size_t kRest = std::size_t{1} << 20;
  std::string bytes;
  bytes.reserve(blob_bytes(content) + kRest);  // growing would copy the blobs once more
  bytes += kFileMagic;
  append_little_endian(bytes, static_cast<std::uint32_t>(kind.size()));
  bytes += kind;
  append_little_endian(bytes, version);
  const std::size_t length_at = bytes.size();
  append_little_endian(bytes, std::uint64_t{0});
  const std::size_t content_at = bytes.size();
  json::to_cbor(content, bytes);  // behind the head: the content may be large
  CborCheck(std::string_view(bytes).substr(content_at)).run();
  std::string length;
  append_little_endian(length, static_cast<std::uint64_t>(bytes.size() - content_at));
  bytes.replace(length_at, length.size(), length);
  append_little_endian(bytes, checksum_of(bytes));
  return bytes;
}

json unpack_record(std::string_view bytes, std::string_view kind, std::uint32_t newest_version,
                   std::uint32_t oldest_version) {
  if (!bytes.starts_with(kFileMagic)) {
    throw InputError("is not a spincat file");
  }
  RecordReader reader(bytes);
  reader.take(kFileMagic.size());
  check_kind(reader, kind);
  check_version(reader, kind, newest_version, oldest_version);
  const std::string_view payload = reader.take(check_length(reader));
  const std::uint32_t checksum = checksum_of(reader.taken());
  if (reader.take_little_endian<std::uint32_t>() != checksum) {
    throw InputError("is damaged: its checksum does not match");
  }
  CborCheck(payload).run();
  try {
    return json::from_cbor(payload);
  } catch (const json::exception& problem) {
    throw InputError(fmt::format("is damaged: its content is not valid CBOR ({})", problem.what()));
  }
}

}  // namespace spincat
