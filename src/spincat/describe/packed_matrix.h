// Matrices as bytes, for messages between ranks. Private to the library, not installed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "spincat/parallel/packing.h"

namespace spincat {

template <int Rows, int Columns, int Options>
void fields(Packer& packer, const Eigen::Matrix<float, Rows, Columns, Options>& matrix) {
  packer(static_cast<std::uint64_t>(matrix.rows()), static_cast<std::uint64_t>(matrix.cols()));
  packer.add(std::span<const float>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

// Straight into the matrix: large ones are never there twice.
template <int Rows, int Columns, int Options>
void fields(Unpacker& unpacker, Eigen::Matrix<float, Rows, Columns, Options>& matrix) {
  const auto rows = unpacker.next<std::uint64_t>();
  const auto columns = unpacker.next<std::uint64_t>();
  matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  unpacker.get_values_into(std::span<float>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

}  // namespace spincat
