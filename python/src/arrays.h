// NumPy arrays in and out: any order, any strides, floats of any width; what does not fit is refused in words.
#pragma once

#include <pybind11/numpy.h>
#include <spincat/spincat.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace spincat::python {

// An array of numbers with two axes, read in place where it holds single or double floats, else as a copy.
class Matrix {
 public:
  // Throws InputError, which begins with `name`, unless it has so many columns.
  Matrix(const pybind11::handle& array, const std::string& name, std::size_t columns);

  std::size_t rows() const { return rows_; }
  bool is_single() const { return single_; }
  // Whether its numbers are single floats, row behind row, without gaps; then where they begin, at any address.
  bool is_packed() const {
    return single_ && column_stride_ == sizeof(float) && row_stride_ == array_.shape(1) * column_stride_;
  }
  const char* bytes() const { return data_; }
  // Three numbers of a row, from `first_column` on.
  Vec3 vector(std::size_t row, std::size_t first_column = 0) const {
    const char* const place = data_ + static_cast<pybind11::ssize_t>(row) * row_stride_ +
                              static_cast<pybind11::ssize_t>(first_column) * column_stride_;
    return single_ ? load<float>(place) : load<double>(place);
  }

 private:
  template <class T>
  Vec3 load(const char* place) const {
    T values[3];
    for (T& value : values) {
      std::memcpy(&value, place, sizeof value);  // strides of a view may leave it anywhere
      place += column_stride_;
    }
    return {static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2])};
  }

  pybind11::array array_;
  const char* data_ = nullptr;
  std::size_t rows_ = 0;
  pybind11::ssize_t row_stride_ = 0;  // bytes
  pybind11::ssize_t column_stride_ = 0;
  bool single_ = false;
};

// N x 3 finite numbers. Throws InputError, which begins with `name`, for others, and where there is no row.
std::vector<Vec3> finite_points(const pybind11::handle& array, const std::string& name);

// Any array, or the words for what is none.
pybind11::array any_array(const pybind11::handle& array, const std::string& name, const std::string& expected);

// "an array of shape (3, 2)".
std::string shape_text(const pybind11::array& array);

// A read-only array over memory that `owner` keeps.
template <class T>
pybind11::array_t<T> view_of(const T* data, std::vector<pybind11::ssize_t> shape, const pybind11::object& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

// An array that owns the vector.
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const pybind11::capsule owner(kept.get(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  const std::vector<T>& vector = *kept.release();
  return pybind11::array_t<T>({static_cast<pybind11::ssize_t>(vector.size())}, vector.data(), owner);
}

// Throws RunError where so many bytes are more than the machine has.
void check_memory(double bytes, const std::string& what);

}  // namespace spincat::python
