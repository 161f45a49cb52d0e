// Values as bytes, for messages between ranks and for the journal. The ranks of a run have one byte order.
//
// A message is described once, by a function that packing and unpacking both run:
//
//   void fields(auto& archive, MessageOf<GramTask> auto& task) {
//     auto& [matrix, strip] = task;  // does not compile when a member is forgotten
//     archive(matrix, strip);
//   }
//
// It stands in the namespace of the message, outside of any unnamed one, so that the archives find it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
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

// A message of this type: one that is read, or one that is filled.
template <class Message, class Type>
concept MessageOf = std::same_as<std::remove_const_t<Message>, Type>;

class Packer {
 public:
  // One after the other: plain values, texts, vectors, and whatever has fields().
  template <class... Values>
  Packer& operator()(const Values&... values) {
    (put(values), ...);
    return *this;
  }

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
  template <class T>
  void put(const T& value) {
    if constexpr (PlainValue<T>) {
      add(value);
    } else if constexpr (std::convertible_to<const T&, std::string_view>) {
      add(std::string_view(value));
    } else {
      fields(*this, value);
    }
  }

  // What an Unpacker fills as an optional.
  template <class T>
  void put(const T* value) {
    put(value != nullptr);
    if (value != nullptr) {
      put(*value);
    }
  }

  template <class T>
  void put(const std::optional<T>& value) {
    put(value ? &*value : nullptr);
  }

  template <class T>
  void put(const std::vector<T>& values) {
    if constexpr (PlainValue<T>) {
      add(std::span<const T>(values));
    } else {
      add(static_cast<std::uint64_t>(values.size()));
      for (const T& value : values) {
        put(value);
      }
    }
  }

  std::string bytes_;
};

// Reads in the order in which it was packed. The bytes must outlive this object. Throws RunError when they end early.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}

  // Fills them, one after the other. A std::string_view points into the bytes.
  template <class... Values>
  Unpacker& operator()(Values&... values) {
    (fill(values), ...);
    return *this;
  }

  // The next message, or whatever else one archive can read.
  template <class T>
  T next() {
    T value{};
    fill(value);
    return value;
  }

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
  template <class T>
  void fill(T& value) {
    if constexpr (PlainValue<T>) {
      value = get<T>();
    } else if constexpr (std::convertible_to<const T&, std::string_view>) {
      value = get_text();
    } else {
      fields(*this, value);
    }
  }

  template <class T>
  void fill(std::optional<T>& value) {
    value.reset();
    if (get<bool>()) {
      fill(value.emplace());
    }
  }

  template <class T>
  void fill(std::vector<T>& values) {
    if constexpr (PlainValue<T>) {
      values = get_values<T>();
    } else {
      values.clear();
      for (auto left = get<std::uint64_t>(); left > 0; --left) {
        fill(values.emplace_back());
      }
    }
  }

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

// One message alone.
template <class Message>
std::string pack(const Message& message) {
  Packer packer;
  packer(message);
  return packer.take();
}

template <class Message>
Message unpack(std::string_view bytes) {
  return Unpacker(bytes).next<Message>();
}

}  // namespace spincat
