#include "spincat/describe/kinds.h"

#include <variant>

namespace spincat {

ObjectKind kind_of(const Object& object) {
  return std::holds_alternative<Mesh>(object) ? ObjectKind::mesh : ObjectKind::cloud;
}

std::string kind_mismatch(ObjectKind met, const KindCounts& learned, TrainedFor trained_for) {
  if (met == ObjectKind::mesh) {
    if (trained_for == TrainedFor::views) {
      return "is a mesh, but the judges were trained by views: they see one view of it";
    }
    return trained_for == TrainedFor::meshes && learned.meshes == 0 && learned.clouds > 0
               ? "is a mesh, but the judges were trained on point clouds alone"
               : "";
  }
  return trained_for == TrainedFor::meshes && learned.clouds == 0 && learned.meshes > 0
             ? "is a point cloud, but the judges were trained on meshes alone (train --for any learns both)"
             : "";
}

}  // namespace spincat
