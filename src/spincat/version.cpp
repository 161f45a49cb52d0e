#include "spincat/version.h"

namespace spincat {

const char* const kVersion = SPINCAT_VERSION;
const char* const kProgram = "spincat " SPINCAT_VERSION;

}  // namespace spincat
