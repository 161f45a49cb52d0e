#include <fmt/format.h>

#include <cmath>

#include "spincat/camera/source/frame_source.h"
#include "spincat/error.h"

namespace spincat {

void Intrinsics::validate() const {
  for (const auto& [name, value] : {std::pair{"fx", fx}, {"fy", fy}}) {
    if (!(value >= 1.0 && value <= 1e6)) {
      throw InputError(fmt::format("focal length {} {} is out of range (1 to 1000000 pixels)", name, value));
    }
  }
  for (const auto& [name, value] : {std::pair{"cx", cx}, {"cy", cy}}) {
    if (!(std::abs(value) <= 1e6)) {
      throw InputError(fmt::format("principal point {} {} is out of range (-1000000 to 1000000 pixels)", name, value));
    }
  }
}

}  // namespace spincat
