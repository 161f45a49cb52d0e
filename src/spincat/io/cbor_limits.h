// Private: what a record's content may be, so that reading it takes memory in proportion to its bytes and no deep
// stack.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

namespace spincat {

// Both throw InputError where the content is nested more than 32 deep or would take far more memory than its bytes, and
// the first where they are not CBOR as nlohmann writes it.
void check_cbor(std::string_view bytes);
// Of content that makes so many bytes of CBOR.
void check_as_cbor(const nlohmann::json& content, std::uint64_t bytes);

}  // namespace spincat
