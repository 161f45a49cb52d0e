#include "spincat/io/formats/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "spincat/error.h"
#include "spincat/io/formats/gltf_buffers.h"
#include "spincat/io/formats/gltf_json.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using nlohmann::json;

// One compressed bufferView.
class Packed {
 public:
  Packed(const json& extension, std::size_t number, std::string_view bytes)
      : number_(number), mode_(word(extension, "mode", "")), filter_(word(extension, "filter", "NONE")), bytes_(bytes) {
    count_ = number_of(extension, "count").value_or(0);
    stride_ = number_of(extension, "byteStride").value_or(0);
  }

  // Exactly as many bytes as there are to be; `room` is what the bufferView has for them.
  std::vector<unsigned char> unpack(std::uint64_t room) const {
    if (stride_ == 0 || stride_ > kLongestStride || count_ > room / stride_) {
      fail(fmt::format("has no room for {} times {} bytes", count_, stride_));
    }
    if (room - count_ * stride_ > kPadding) {
      fail(fmt::format("is to have {} bytes, but {} times {} are compressed", room, count_, stride_));
    }
    std::vector<unsigned char> out(count_ * stride_);
    if (decode(out.data()) != 0) {
      fail(is_newer() ? "is compressed by a newer meshoptimizer, which spincat does not read"
                      : "holds compressed data that is damaged");
    }
    apply_filter(out.data());
    return out;
  }

 private:
  static constexpr std::uint64_t kLongestStride = 256;
  static constexpr std::uint64_t kPadding = 3;

  static std::string_view word(const json& extension, const char* key, std::string_view otherwise) {
    const std::string* text = text_of(extension, key);
    return text != nullptr ? std::string_view(*text) : otherwise;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("its bufferView {} {}", number_, problem));
  }

  // meshoptimizer asserts what is checked here.
  int decode(unsigned char* out) const {
    const auto* in = reinterpret_cast<const unsigned char*>(bytes_.data());
    if (mode_ == "ATTRIBUTES" && stride_ % 4 == 0) {
      return meshopt_decodeVertexBuffer(out, count_, stride_, in, bytes_.size());
    }
    const bool indices = stride_ == 2 || stride_ == 4;
    if (mode_ == "TRIANGLES" && indices && count_ % 3 == 0) {
      return meshopt_decodeIndexBuffer(out, count_, stride_, in, bytes_.size());
    }
    if (mode_ == "INDICES" && indices) {
      return meshopt_decodeIndexSequence(out, count_, stride_, in, bytes_.size());
    }
    fail(fmt::format("is compressed in the mode {} with {} times {} bytes, which does not exist", in_quotes(mode_),
                     count_, stride_));
  }

  // The low half of the first byte is the version of the encoding.
  bool is_newer() const {
    constexpr unsigned kNewest[] = {0, 1};  // of vertices, of indices
    return !bytes_.empty() &&
           (static_cast<unsigned char>(bytes_[0]) & 0x0FU) > (mode_ == "ATTRIBUTES" ? kNewest[0] : kNewest[1]);
  }

  void apply_filter(unsigned char* values) const {
    if (filter_ == "NONE" || filter_ == "COLOR") {  // colours are no shape
      return;
    }
    if (mode_ == "ATTRIBUTES" && filter_ == "OCTAHEDRAL" && (stride_ == 4 || stride_ == 8)) {
      meshopt_decodeFilterOct(values, count_, stride_);
    } else if (mode_ == "ATTRIBUTES" && filter_ == "QUATERNION" && stride_ == 8) {
      meshopt_decodeFilterQuat(values, count_, stride_);
    } else if (mode_ == "ATTRIBUTES" && filter_ == "EXPONENTIAL") {
      meshopt_decodeFilterExp(values, count_, stride_);
    } else {
      fail(fmt::format("has the filter {} for the mode {} and {} bytes, which does not exist", in_quotes(filter_),
                       in_quotes(mode_), stride_));
    }
  }

  std::size_t number_;
  std::string_view mode_;
  std::string_view filter_;
  std::string_view bytes_;
  std::uint64_t count_ = 0;
  std::uint64_t stride_ = 0;
};

}  // namespace

std::uint64_t meshopt_size(const json& document) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < array_size(document, "bufferViews"); ++i) {
    const json& view = *element(document, "bufferViews", i);
    if (const json* compression = meshopt_extension(view)) {
      sum = std::min(kMost, sum + std::min(kMost, number_of(view, "byteLength").value_or(0)));
      sum = std::min(kMost, sum + std::min(kMost, number_of(*compression, "byteLength").value_or(0)));
    }
  }
  return sum;
}

void unpack_meshopt(const json& document, std::vector<std::string>& buffers) {
  for (std::size_t i = 0; i < array_size(document, "bufferViews"); ++i) {
    const json& view = *element(document, "bufferViews", i);
    const json* compression = meshopt_extension(view);
    if (compression == nullptr) {
      continue;
    }
    const std::optional<std::string_view> packed = view_bytes(*compression, buffers);
    const std::optional<std::string_view> room = view_bytes(view, buffers);
    if (!packed || !room) {
      throw InputError(fmt::format("its bufferView {} reaches beyond its buffer", i));
    }
    const std::vector<unsigned char> bytes = Packed(*compression, i, *packed).unpack(room->size());
    std::string& buffer = buffers[*number_of(view, "buffer")];
    std::ranges::copy(bytes, buffer.begin() + (room->data() - buffer.data()));
  }
}

}  // namespace spincat::io
