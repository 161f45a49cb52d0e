#include "spincat/judge/settings.h"

#include "spincat/error.h"

namespace spincat {

double default_c(const JudgeSettings& settings) {
  if (settings.kernel == KernelKind::rbf) {
    return 3.0;
  }
  return settings.dimensions > 0 ? 10.0 : 200.0;
}

void JudgeSettings::validate() const {
  check_range("dimensions", dimensions, kDimensions);
  check_range("c", c, kC);
  if (dimensions > 0 && kernel != KernelKind::linear) {
    throw InputError("dimensions need the linear kernel: rbf compares the features themselves");
  }
}

}  // namespace spincat
