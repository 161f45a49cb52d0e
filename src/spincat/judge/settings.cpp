#include "spincat/judge/settings.h"

namespace spincat {

double default_c(KernelKind kernel) {
  return kernel == KernelKind::linear ? 200.0 : 3.0;
}

void JudgeSettings::validate() const {
  check_range("c", c, kC);
}

}  // namespace spincat
