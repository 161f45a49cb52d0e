#include "spincat/files/cbor_limits.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "spincat/error.h"

namespace spincat {
namespace {

using nlohmann::json;

constexpr std::size_t kDeepest = 32;

// What nlohmann's parser takes for an item, but for what is in strings and blobs: a list holds its old and its new
// memory while it grows.
std::uint64_t memory_of_item(bool is_on_heap) {
  constexpr std::uint64_t kInList = 3 * sizeof(json);
  constexpr std::uint64_t kOnHeap = 64;
  return kInList + (is_on_heap ? kOnHeap : 0);
}

[[noreturn]] void throw_too_deep() {
  throw InputError(fmt::format("is damaged: its content is nested more than {} deep", kDeepest));
}

// Looks through CBOR, without recursion, for what to_cbor never writes: containers nested too deep, and strings or
// containers of no stated length; and for content that would take far more memory than its bytes, as a million empty
// lists would. nlohmann's parser recurses for each level of both, and in strings it does so without
// asking its SAX handler, so that a handler alone cannot keep 50,000 levels from overflowing the stack.
class CborCheck {
 public:
  explicit CborCheck(std::string_view bytes) : bytes_(bytes) {}

  void run() {
    look_through();
    check_growth(memory_, bytes_.size());
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
          throw_too_deep();
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
    memory_ += memory_of_item(head >> 5 >= 2 && head >> 5 <= 5);
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
  std::uint64_t memory_ = 0;
};

// Of an item and all in it.
std::uint64_t memory_of(const json& item, std::uint64_t places, std::size_t level) {
  const bool has_subtype = item.is_binary() && item.get_binary().has_subtype();
  if (item.is_discarded() || (has_subtype && item.get_binary().subtype() >= places)) {
    throw InputError("cannot be written: its content is not plain CBOR");
  }
  std::uint64_t memory = memory_of_item(item.is_structured() || item.is_string() || item.is_binary());
  if (!item.is_structured()) {
    return memory;
  }
  if (!item.empty() && level == kDeepest) {
    throw_too_deep();
  }
  for (const json& inner : item) {
    memory += memory_of(inner, places, level + 1) + (item.is_object() ? memory_of_item(true) : 0);
  }
  return memory;
}

}  // namespace

void check_cbor(std::string_view bytes) {
  CborCheck(bytes).run();
}

std::uint64_t memory_to_read(const json& content, std::uint64_t places) {
  return memory_of(content, places, 0);
}

void check_growth(std::uint64_t memory, std::uint64_t bytes) {
  constexpr std::uint64_t kFree = 8'000'000;
  constexpr std::uint64_t kMostGrowth = 12;  // the blobs come on top of it
  if (memory > kFree + kMostGrowth * bytes) {
    throw InputError(fmt::format("is damaged: its content would take {} bytes of memory", memory));
  }
}

}  // namespace spincat
