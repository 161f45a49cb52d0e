// Looking into the JSON of a glTF file, whose every value may be anything. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace spincat::io {

// The member of that name; nullptr where there is none or `object` is no object.
inline const nlohmann::json* member(const nlohmann::json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? &*found : nullptr;
}
inline nlohmann::json* member(nlohmann::json& object, const char* key) {
  return const_cast<nlohmann::json*>(member(std::as_const(object), key));
}

// The element of the list `key` of the document; nullptr where there is none.
inline const nlohmann::json* element(const nlohmann::json& document, const char* key, std::uint64_t index) {
  const nlohmann::json* list = member(document, key);
  return list != nullptr && list->is_array() && index < list->size() ? &(*list)[index] : nullptr;
}
inline nlohmann::json* element(nlohmann::json& document, const char* key, std::uint64_t index) {
  return const_cast<nlohmann::json*>(element(std::as_const(document), key, index));
}

inline std::size_t array_size(const nlohmann::json& object, const char* key) {
  const nlohmann::json* list = member(object, key);
  return list != nullptr && list->is_array() ? list->size() : 0;
}

// A number that is not negative; none where there is none of that name.
inline std::optional<std::uint64_t> number_of(const nlohmann::json& object, const char* key) {
  const nlohmann::json* value = member(object, key);
  return value != nullptr && value->is_number_unsigned() ? std::optional(value->get<std::uint64_t>()) : std::nullopt;
}

inline const std::string* text_of(const nlohmann::json& object, const char* key) {
  const nlohmann::json* value = member(object, key);
  return value != nullptr ? value->get_ptr<const std::string*>() : nullptr;
}

// What an extension of that name says of an object; nullptr where there is none.
inline const nlohmann::json* extension(const nlohmann::json& object, const char* name) {
  const nlohmann::json* extensions = member(object, "extensions");
  return extensions != nullptr ? member(*extensions, name) : nullptr;
}

// The same, by either name of the compression of meshoptimizer.
inline const nlohmann::json* meshopt_extension(const nlohmann::json& object) {
  const nlohmann::json* khronos = extension(object, "KHR_meshopt_compression");
  return khronos != nullptr ? khronos : extension(object, "EXT_meshopt_compression");
}

}  // namespace spincat::io
