#include "spincat/judge/settings.h"

#include <fmt/format.h>

#include <cmath>

#include "spincat/error.h"

namespace spincat {

double default_c(KernelKind kernel) {
  return kernel == KernelKind::linear ? 200.0 : 3.0;
}

void JudgeSettings::validate() const {
  if (!(c > 0.0) || !std::isfinite(c)) {
    throw InputError(fmt::format("C {} is out of range (above 0)", c));
  }
}

}  // namespace spincat
