// Values as bytes, for messages between ranks and for the journal. The ranks of a run have one byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "spincat/error.h"

namespace spincat {

template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Packer {
 public:
  template <PlainValue T>
  Packer& add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }

  // The length, then what is in it.
  Packer& add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
    return *this;
  }

  template <PlainValue T>
  Packer& add(std::span<const T> values) {
    return add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
  }

  // For so many bytes in all: a large message need not grow.
  Packer& reserve(std::size_t bytes) {
    bytes_.reserve(bytes);
    return *this;
  }

  // Bytes to the end: what Unpacker::rest() gives.
  Packer& add_rest(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads in the order in which it was packed. The bytes must outlive this object. Throws RunError when they end early.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}

  template <PlainValue T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string_view get_text() { return take(get<std::uint64_t>()); }

  template <PlainValue T>
  std::vector<T> get_values() {
    const std::string_view bytes = get_text();
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) {
      std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    }
    return values;
  }

  // What was packed as a span, into one of the same length. Throws RunError when it has another.
  template <PlainValue T>
  void get_values_into(std::span<T> values) {
    const std::string_view bytes = get_text();
    if (bytes.size() != values.size_bytes()) {
      throw RunError("a message between ranks has another length than was expected");
    }
    if (!bytes.empty()) {
      std::memcpy(values.data(), bytes.data(), bytes.size());
    }
  }

  bool empty() const { return left_.empty(); }
  std::string_view rest() const { return left_; }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > left_.size()) {
      throw RunError("a message between ranks ends early");
    }
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }

  std::string_view left_;
};

}  // namespace spincat
