// The values that a number may have, and the words for one that it may not have.
#pragma once

#include <string>
#include <string_view>

#pragma GCC visibility push(default)
namespace spincat {

// From `low` to `high`, both allowed unless `above` says that `low` is not. Infinite bounds are none.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool above = false;

  // False for NaN and for infinite values.
  bool holds(double value) const;
  // "1 to 10,000,000", "above 0".
  std::string text() const;
};

// Throw InputError "NAME VALUE: expected RANGE" when the value is not in the range.
void check_range(std::string_view name, int value, const Range& range);
void check_range(std::string_view name, double value, const Range& range);

}  // namespace spincat
#pragma GCC visibility pop
