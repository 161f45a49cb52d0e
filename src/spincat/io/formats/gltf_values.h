// The numbers of a glTF accessor. Private to io.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/gltf_document.h"

namespace spincat::io {

// The element that an index of the file names; "its node 3 does not exist" where it names none.
template <typename T>
const T& element_at(const std::vector<T>& list, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
    throw InputError(fmt::format("its {} {} does not exist ({} do)", what, index, list.size()));
  }
  return list[static_cast<std::size_t>(index)];
}

// An accessor whose every value is known to lie in its buffer. A sparse one replaces some of its elements by others;
// without a bufferView the rest are zero.
class GltfValues {
 public:
  // type: TINYGLTF_TYPE_VEC3 and the like. Throws InputError where the accessor is of another, or reaches too far.
  GltfValues(const tinygltf::Model& model, int index, int type);

  // Throws InputError where the elements that a sparse accessor replaces are not named in order: they are looked up by
  // halves. Takes time in proportion to their number, so it is not for every look at an accessor.
  void check_order() const;

  std::size_t count() const { return count_; }
  double value(std::size_t element, std::size_t component) const;
  Vec3 vector(std::size_t element) const { return {value(element, 0), value(element, 1), value(element, 2)}; }
  // The element as the index of a vertex, of which there are so many.
  std::uint32_t index(std::size_t element, std::size_t vertices) const;

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  // Rows of a buffer; none where data is null.
  struct Rows {
    const char* data = nullptr;
    std::size_t stride = 0;

    const char* at(std::size_t row) const { return data + row * stride; }
  };

  Rows rows(const tinygltf::Model& model, int view, std::uint64_t offset, std::size_t count, std::size_t size) const;
  void read_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor);
  ScalarType component_type(int type) const;
  const char* row_of(std::size_t element) const;
  std::size_t replaced(std::size_t i) const;
  double largest() const;

  int index_;
  ScalarType type_ = ScalarType::float32;
  bool normalized_ = false;
  std::size_t count_ = 0;
  std::size_t element_size_ = 0;
  Rows base_;
  std::size_t sparse_ = 0;  // how many elements are replaced
  ScalarType sparse_type_ = ScalarType::uint32;
  Rows sparse_indices_;
  Rows sparse_values_;
};

}  // namespace spincat::io
