// What a record's content may be, so that reading it takes memory in proportion to its bytes and no deep
// stack.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

namespace spincat {

// Throws InputError where the bytes are not CBOR as nlohmann writes it, are nested more than 32 deep or would take far
// more memory than they are.
void check_cbor(std::string_view bytes);

// The same before content is written: what reading it will take, and whether that is too much for so many bytes.
// `places` blobs are elsewhere (RecordBlobs). Throw InputError.
std::uint64_t memory_to_read(const nlohmann::json& content, std::uint64_t places);
void check_growth(std::uint64_t memory, std::uint64_t bytes);

}  // namespace spincat
