#include "spincat/io/formats/gltf_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "spincat/error.h"

namespace spincat::io {

GltfValues::GltfValues(const tinygltf::Model& model, int index, int type) : index_(index) {
  const tinygltf::Accessor& accessor = element_at(model.accessors, index, "accessor");
  if (accessor.bufferView < 0 && !accessor.sparse.isSparse) {
    fail("has no data in the file (it may be compressed)");
  }
  if (accessor.type != type) {
    fail("holds values of the wrong kind");
  }
  type_ = component_type(accessor.componentType);
  normalized_ = accessor.normalized;
  count_ = accessor.count;
  element_size_ = size_of(type_) *
                  static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  if (accessor.bufferView >= 0) {
    base_ = rows(model, accessor.bufferView, accessor.byteOffset, count_, element_size_);
  }
  if (accessor.sparse.isSparse) {
    read_sparse(model, accessor);
  }
}

GltfValues::Rows GltfValues::rows(const tinygltf::Model& model, int view_index, std::uint64_t offset, std::size_t count,
                                  std::size_t size) const {
  const tinygltf::BufferView& view = element_at(model.bufferViews, view_index, "bufferView");
  const std::vector<unsigned char>& buffer = element_at(model.buffers, view.buffer, "buffer").data;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    throw InputError(fmt::format("its bufferView {} reaches beyond its buffer", view_index));
  }
  const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
  if (stride < size) {
    fail("has values that overlap");
  }
  if (count > 0 && (offset > view.byteLength || size > view.byteLength - offset ||
                    count - 1 > (view.byteLength - offset - size) / stride)) {
    fail("reaches beyond its bufferView");
  }
  return {reinterpret_cast<const char*>(buffer.data()) + view.byteOffset + (count > 0 ? offset : 0), stride};
}

void GltfValues::read_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > count_) {
    fail(fmt::format("replaces {} of its {} values", sparse.count, count_));
  }
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    fail("reaches beyond its bufferView");
  }
  sparse_ = static_cast<std::size_t>(sparse.count);
  sparse_type_ = component_type(sparse.indices.componentType);
  if (sparse_type_ != ScalarType::uint8 && sparse_type_ != ScalarType::uint16 && sparse_type_ != ScalarType::uint32) {
    fail("names the values that it replaces by numbers that are no indices");
  }
  sparse_indices_ = rows(model, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset),
                         sparse_, size_of(sparse_type_));
  sparse_values_ = rows(model, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset), sparse_,
                        element_size_);
}

void GltfValues::check_order() const {
  for (std::size_t i = 0; i < sparse_; ++i) {
    if (replaced(i) >= count_) {
      fail(fmt::format("replaces the value {}, which does not exist ({} do)", replaced(i), count_));
    }
    if (i > 0 && replaced(i) <= replaced(i - 1)) {
      fail(fmt::format("replaces the value {} after the value {}", replaced(i), replaced(i - 1)));
    }
  }
}

std::size_t GltfValues::replaced(std::size_t i) const {
  return static_cast<std::size_t>(load_scalar(sparse_indices_.at(i), sparse_type_));
}

// Null where the element is zero.
const char* GltfValues::row_of(std::size_t element) const {
  std::size_t begin = 0;
  for (std::size_t end = sparse_; begin < end;) {
    const std::size_t middle = begin + (end - begin) / 2;
    replaced(middle) < element ? begin = middle + 1 : end = middle;
  }
  if (begin < sparse_ && replaced(begin) == element) {
    return sparse_values_.at(begin);
  }
  return base_.data == nullptr ? nullptr : base_.at(element);
}

double GltfValues::value(std::size_t element, std::size_t component) const {
  const char* row = row_of(element);
  const double raw = row == nullptr ? 0 : load_scalar(row + component * size_of(type_), type_);
  return normalized_ ? std::max(raw / largest(), -1.0) : raw;
}

std::uint32_t GltfValues::index(std::size_t element, std::size_t vertices) const {
  const double index = value(element, 0);
  if (!(index >= 0 && index < static_cast<double>(vertices))) {
    fail(fmt::format("holds the vertex index {}, which is out of range ({} vertices)", index, vertices));
  }
  return static_cast<std::uint32_t>(index);
}

void GltfValues::fail(const std::string& problem) const {
  throw InputError(fmt::format("its accessor {} {}", index_, problem));
}

ScalarType GltfValues::component_type(int type) const {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return ScalarType::int8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return ScalarType::uint8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return ScalarType::int16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return ScalarType::uint16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return ScalarType::uint32;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return ScalarType::float32;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return ScalarType::float64;
    default:
      fail(fmt::format("has the unknown componentType {}", type));
  }
}

// What a normalized integer divides by to become 1.
double GltfValues::largest() const {
  switch (type_) {
    case ScalarType::int8:
      return 127;
    case ScalarType::uint8:
      return 255;
    case ScalarType::int16:
      return 32767;
    case ScalarType::uint16:
      return 65535;
    default:
      return 1;
  }
}

}  // namespace spincat::io
