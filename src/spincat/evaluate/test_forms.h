// The forms in which objects are tested: what becomes of a model on its way through scanners and other people's hands.
#pragma once

#include <cstdint>

#include "spincat/evaluate/evaluate.h"
#include "spincat/geometry/object.h"

namespace spincat {

// The object in the form it is tested in (TestForm says which there are). Deterministic: the same for the same object,
// options and seed. Throws InputError when a mesh without area is to become anything but turned or noisy, when a cloud
// is to have holes or inner structure, and when an object without extent is to become a noisy mesh.
Object in_test_form(const Object& object, const TestOptions& options, std::uint64_t seed);

}  // namespace spincat
