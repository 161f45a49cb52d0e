#include "spincat/describe/kinds.h"

#include <variant>

namespace spincat {

ObjectKind kind_of(const Object& object) {
  return std::holds_alternative<Mesh>(object) ? ObjectKind::mesh : ObjectKind::cloud;
}

std::string misfit(ObjectKind met, const KindCounts& learned, TaughtFor taught_for) {
  if (met == ObjectKind::mesh) {
    if (taught_for == TaughtFor::views) {
      return "is a mesh, but the judges were taught by views: they see one view of it";
    }
    return taught_for == TaughtFor::meshes && learned.meshes == 0 && learned.clouds > 0
               ? "is a mesh, but the judges were taught on point clouds alone"
               : "";
  }
  return taught_for == TaughtFor::meshes && learned.clouds == 0 && learned.meshes > 0
             ? "is a point cloud, but the judges were taught on meshes alone (train --for any teaches both)"
             : "";
}

}  // namespace spincat
