// Points with normals, laid out for vectorised loops.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// Memory for vectorised loops.
inline constexpr std::size_t kAlignment = 64;  // bytes: a cache line, and the widest vector register in use

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor): allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kAlignment})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kAlignment}); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

using AlignedFloats = std::vector<float, AlignedAllocator<float>>;

// N points with unit normals as six separate float arrays of length N: a structure of arrays. Every array starts on a
// cache line and is padded with zeros to a multiple of 16 floats, so that a kernel may read (not use) past its end.
//
//   points.x()[i], points.y()[i], points.z()[i]      position of point i
//   points.nx()[i], points.ny()[i], points.nz()[i]   its normal, of length 1
class OrientedPoints {
 public:
  OrientedPoints() = default;
  explicit OrientedPoints(std::size_t size) : size_(size), stride_((size + 15) / 16 * 16), data_(6 * stride_, 0.0F) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  std::span<const float> x() const { return array(0); }
  std::span<const float> y() const { return array(1); }
  std::span<const float> z() const { return array(2); }
  std::span<const float> nx() const { return array(3); }
  std::span<const float> ny() const { return array(4); }
  std::span<const float> nz() const { return array(5); }

  Eigen::Vector3f position(std::size_t i) const { return {at(0, i), at(1, i), at(2, i)}; }
  Eigen::Vector3f normal(std::size_t i) const { return {at(3, i), at(4, i), at(5, i)}; }

  void set(std::size_t i, const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
    for (int axis = 0; axis < 3; ++axis) {
      data_[axis * stride_ + i] = position[axis];
      data_[(3 + axis) * stride_ + i] = normal[axis];
    }
  }

 private:
  std::span<const float> array(std::size_t k) const { return {data_.data() + k * stride_, size_}; }
  float at(std::size_t k, std::size_t i) const { return data_[k * stride_ + i]; }

  std::size_t size_ = 0;
  std::size_t stride_ = 0;  // floats from one array to the next
  AlignedFloats data_;
};

}  // namespace spincat
#pragma GCC visibility pop
