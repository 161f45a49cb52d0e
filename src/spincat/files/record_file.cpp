#include "spincat/files/record_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <ostream>
#include <streambuf>

#include "spincat/error.h"
#include "spincat/files/cbor_limits.h"
#include "spincat/files/magic.h"
#include "spincat/files/output_file.h"

namespace spincat {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestKind = 32;
constexpr std::size_t kChecksumBytes = 4;

template <class T>
void append_little_endian(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  }
}

std::uint32_t checksum_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
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

using Take = std::function<void(std::string_view piece)>;

// A stream's bytes, small ones gathered, as pieces.
class PieceBuffer : public std::streambuf {
 public:
  explicit PieceBuffer(const Take& take) : take_(take) { empty(); }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    const auto size = static_cast<std::size_t>(count);
    if (size < gathered_.size()) {
      return std::streambuf::xsputn(bytes, count);
    }
    sync();
    take_({bytes, size});
    return count;
  }

  int_type overflow(int_type c) override {
    sync();
    return sputc(traits_type::to_char_type(c));
  }

  int sync() override {
    take_({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    empty();
    return 0;
  }

 private:
  void empty() { setp(gathered_.data(), gathered_.data() + gathered_.size()); }

  const Take& take_;
  std::array<char, 1 << 16> gathered_;
};

// The first bytes of a CBOR item of a major type, with its length in as few bytes as it needs.
void write_head(std::uint8_t major_type, std::uint64_t length, std::ostream& stream) {
  constexpr std::uint64_t kWithin = 23;  // the first byte has these itself
  std::string head(1, static_cast<char>(major_type << 5));
  if (length <= kWithin) {
    head[0] = static_cast<char>(head[0] | static_cast<char>(length));
  } else {
    int size = 0;  // its logarithm
    while (size < 3 && length >> (8 << size) != 0) {
      ++size;
    }
    head[0] = static_cast<char>(head[0] | static_cast<char>(kWithin + 1 + static_cast<std::uint64_t>(size)));
    for (int byte = (1 << size) - 1; byte >= 0; --byte) {
      head += static_cast<char>(length >> (8 * byte) & 0xFF);
    }
  }
  stream << head;
}

// As json::to_cbor writes it where the blobs are in it.
void write_cbor(const json& content, const RecordBlobs& blobs, std::ostream& stream) {
  constexpr std::uint8_t kBytes = 2;
  constexpr std::uint8_t kMap = 5;
  if (RecordBlobs::is_place(content)) {
    const std::string_view bytes = blobs.bytes(content);
    write_head(kBytes, bytes.size(), stream);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  } else if (content.is_object()) {
    write_head(kMap, content.size(), stream);
    for (const auto& [name, value] : content.items()) {
      json::to_cbor(name, stream);
      write_cbor(value, blobs, stream);
    }
  } else {
    json::to_cbor(content, stream);
  }
}

// The content as CBOR, piece by piece. What `take` throws comes through.
void to_pieces(const json& content, const RecordBlobs& blobs, const Take& take) {
  PieceBuffer buffer(take);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  write_cbor(content, blobs, stream);
  stream.flush();
}

void pack_pieces(std::string_view kind, std::uint32_t version, const json& content, const RecordBlobs& blobs,
                 const Take& take) {
  if (!is_kind(kind)) {
    throw InputError(fmt::format("a kind of record is up to {} letters from a to z", kLongestKind));
  }
  const std::uint64_t memory = memory_to_read(content, blobs.size());
  std::uint64_t length = 0;
  to_pieces(content, blobs, [&](std::string_view piece) { length += piece.size(); });
  check_growth(memory, length);
  std::string head(kFileMagic);
  append_little_endian(head, static_cast<std::uint32_t>(kind.size()));
  head += kind;
  append_little_endian(head, version);
  append_little_endian(head, length);
  std::uint32_t checksum = 0;
  const auto take_checked = [&](std::string_view piece) {
    checksum = checksum_of(piece, checksum);
    take(piece);
  };
  take_checked(head);
  to_pieces(content, blobs, take_checked);
  std::string tail;
  append_little_endian(tail, checksum);
  take(tail);
}

}  // namespace

json RecordBlobs::add(std::span<const std::byte> numbers) {
  blobs_.emplace_back(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  return json::binary(json::binary_t::container_type(), blobs_.size() - 1);
}

std::string_view RecordBlobs::bytes(const json& place) const {
  return blobs_.at(place.get_binary().subtype());
}

bool RecordBlobs::is_place(const json& value) {
  return value.is_binary() && value.get_binary().has_subtype();
}

void write_record(const std::filesystem::path& file, std::string_view kind, std::uint32_t version, const json& content,
                  const RecordBlobs& blobs) {
  OutputFile out(file);
  pack_pieces(kind, version, content, blobs, [&](std::string_view piece) { out.write(piece); });
  out.commit();
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
  check_cbor(payload);
  try {
    return json::from_cbor(payload);
  } catch (const json::exception& problem) {
    throw InputError(fmt::format("is damaged: its content is not valid CBOR ({})", problem.what()));
  }
}

}  // namespace spincat
