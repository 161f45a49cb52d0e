// The safe container of every file that spincat
// writes for itself, the model first of all.
//
//   bytes  what
//   8      "SPINCAT" and 0x1A, which stops a `type` of the file on a terminal
//   4 + k  length and text of the kind, as "model"
//   4      version of the kind's format
//   8      length of the content
//   n      the content as CBOR; large arrays of numbers as binary blobs
//   4      CRC-32 (zlib's) of everything before it
//
// Numbers are unsigned and little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

// Arrays of numbers that a record holds as blobs and that stay where they are until they are written: a model's may be
// large. They must outlive this object.
class RecordBlobs {
 public:
  // What stands for the blob in the record's content, as a member of an object (not in a list).
  nlohmann::json add(std::span<const float> numbers) { return add(std::as_bytes(numbers)); }
  nlohmann::json add(std::span<const std::byte> numbers);
  std::string_view bytes(const nlohmann::json& place) const;  // of what add() gave
  std::size_t size() const { return blobs_.size(); }
  static bool is_place(const nlohmann::json& value);

 private:
  std::vector<std::string_view> blobs_;
};

// Writes a record to a file, which holds either what it held before or all of it (OutputFile). `kind` is up to 32
// lower-case letters; `content` may be nested 32 deep, and its binary blobs have no subtypes. Throws InputError where
// unpack_record would refuse it, and as OutputFile does.
void write_record(const std::filesystem::path& file, std::string_view kind, std::uint32_t version,
                  const nlohmann::json& content, const RecordBlobs& blobs = {});

// The content of a record of this kind and of a version from `oldest_version` to `newest_version`. The magic, kind,
// version, length and checksum are checked in this order, so that the message names what is really the matter. Throws
// InputError, without the file's name, for anything else; no bytes, however made, crash it.
nlohmann::json unpack_record(std::string_view bytes, std::string_view kind, std::uint32_t newest_version,
                             std::uint32_t oldest_version = 1);

}  // namespace spincat
