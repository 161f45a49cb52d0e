// Which points of a file are left, where some were left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spincat {

// The numbers below `kept` + left_out.size() that are not among those left out, ascending: which of a file's points the
// `kept` points of an object are. Precondition: left_out ascends and holds no number twice or too large.
inline std::vector<std::uint32_t> rows_of_kept(std::size_t kept, std::span<const std::uint32_t> left_out) {
  std::vector<std::uint32_t> rows;
  rows.reserve(kept);
  auto next = left_out.begin();
  for (std::uint32_t row = 0; rows.size() < kept; ++row) {
    if (next != left_out.end() && *next == row) {
      ++next;
    } else {
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace spincat
