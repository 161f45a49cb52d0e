#include <fmt/format.h>

#include "spincat/error.h"
#include "spincat/prepare/prepare.h"

namespace spincat {
namespace {

void check_range(const char* field, int value, int low, int high) {
  if (value < low || value > high) {
    throw InputError(fmt::format("{} {} is out of range ({} to {})", field, value, low, high));
  }
}

}  // namespace

void PrepareSettings::validate() const {
  check_range("number of surface points", points, 1, 10'000'000);
  check_range("number of spin points", spin_points, 1, 10'000'000);
  check_range("number of neighbours", neighbours, 3, 1'000);
}

}  // namespace spincat
