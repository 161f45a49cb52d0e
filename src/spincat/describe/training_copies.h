// What a training object is shown as: itself, stretched, as a cloud, or as views of a depth camera.
#pragma once

#include <cstdint>
#include <optional>

#include "spincat/geometry/object.h"
#include "spincat/settings/settings.h"

namespace spincat {

// A shape, and the seed of the points that stand for it: another copy is another look at another shape.
struct TrainingCopy {
  Object object;
  std::uint64_t seed = 0;
};

// The training copy number `k` of an object, 0 to settings.training_rows() - 1. 0 is the object itself; the first
// settings.copies are stretched; those after them are stretched and turned into clouds of settings.prepare.points
// points, every other one exact and every other one with noise of 1 % of the diameter. With TrainedFor::views a mesh is
// view number `k` of it (camera/render/views.h), 0 included, no two meshes being looked at from the same places; a
// cloud is taken to be a view and to stand upright, z up. Deterministic. Throws InputError (without a file name) when
// the object shows nothing to a camera.
TrainingCopy training_copy(const Object& object, const Settings& settings, int k);

// What judges see of an object that is to be named, where that is not the object itself: one view of a mesh, where they
// learned by views. Otherwise nothing. Deterministic; throws as training_copy does.
std::optional<Object> shown_instead(const Object& object, const Settings& settings);

}  // namespace spincat
