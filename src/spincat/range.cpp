#include "spincat/range.h"

#include <fmt/format.h>

#include <cmath>

#include "spincat/error.h"

namespace spincat {
namespace {

// Digits in groups of three: a number of zeros is hard to read.
std::string grouped(double number) {
  std::string text = fmt::format("{}", number);
  if (std::abs(number) >= 1e15 || number != std::floor(number)) {
    return text;
  }
  text = fmt::format("{:.0f}", number);
  const std::size_t sign = text.front() == '-' ? 1 : 0;
  for (std::size_t at = text.size(); at > sign + 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

}  // namespace

bool Range::holds(double value) const {
  return std::isfinite(value) && (above ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
  if (above && std::isinf(high)) {
    return "a number above " + grouped(low);
  }
  return above ? fmt::format("above {} to {}", grouped(low), grouped(high))
               : fmt::format("{} to {}", grouped(low), grouped(high));
}

void check_range(std::string_view name, int value, const Range& range) {
  if (!range.holds(value)) {
    throw InputError(fmt::format("{} {}: expected {}", name, value, range.text()));
  }
}

void check_range(std::string_view name, double value, const Range& range) {
  if (!range.holds(value)) {
    throw InputError(fmt::format("{} {}: expected {}", name, value, range.text()));
  }
}

}  // namespace spincat
