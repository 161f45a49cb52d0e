// The kinds of objects that judges learned from, and those that they meet.
#pragma once

#include <cstdint>
#include <string>

#include "spincat/geometry/object.h"
#include "spincat/settings/settings.h"

namespace spincat {

enum class ObjectKind { mesh, cloud };

ObjectKind kind_of(const Object& object);

// How many objects of each kind.
struct KindCounts {
  std::uint32_t meshes = 0;
  std::uint32_t clouds = 0;

  void add(ObjectKind kind) { ++(kind == ObjectKind::mesh ? meshes : clouds); }
};

// Why judges that were trained so, on these objects, should not be trusted with one of that kind: "is a mesh, but ...";
// empty where they may be.
std::string kind_mismatch(ObjectKind met, const KindCounts& learned, TrainedFor trained_for);

}  // namespace spincat
