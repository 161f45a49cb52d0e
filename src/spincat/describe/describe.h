// One object to its feature vector: prepare, spin, encode.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "spincat/encode/feature_vector.h"
#include "spincat/geometry/object.h"
#include "spincat/geometry/up_axis.h"
#include "spincat/prepare/prepare.h"
#include "spincat/settings/settings.h"
#include "spincat/spin/params.h"

namespace spincat {

// Seconds spent in each stage (the paper's Figure 3).
struct StageSeconds {
  double read = 0.0;
  double prepare = 0.0;
  double spin = 0.0;
  double encode = 0.0;
  double judge = 0.0;  // training or voting
  StageSeconds& operator+=(const StageSeconds& other);
};

// What an object's spin images are made of, and how: parameters in the unit of the prepared points.
struct Preparation {
  PreparedObject object;
  SpinImageParams params;
};

// Makes the feature vector of prepared points somewhere else: dense_object.h shares them out.
using EncodePrepared = std::function<FeatureVector(const Preparation&)>;

// The feature vector of an object, or of its training copy number `copy`, 1 to settings.training_rows() - 1: the first
// settings.copies are stretched, those after them are stretched and turned into clouds of settings.prepare.points
// points, every other one exact and every other one with noise of 1 % of the diameter. With TrainedFor::views a mesh is
// view number `copy` of it (camera/render/views.h), 0 included, no two meshes being looked at from the same places; a
// cloud is taken to be a view and to stand upright, z up. On this thread unless `elsewhere` says otherwise.
// Deterministic. Adds the time spent to `seconds` where one is given. Throws InputError (without a file name) when the
// object has no extent, or shows nothing to a camera.
FeatureVector describe(const Object& object, const Settings& settings, int copy = 0, StageSeconds* seconds = nullptr,
                       const EncodePrepared& elsewhere = {});

// The first stage of describe by itself, for those who want the spin images: of an object, or of its training copy
// number `copy`; the first part's first draw. Deterministic. Throws as describe does, and when the bin size is out of
// range for this object.
Preparation prepare_object(const Object& object, const Settings& settings, int copy = 0);

// What one part of an object's feature vector is made of, in one draw of its points.
struct PreparedPart {
  Preparation preparation;
  SurfaceKind surface = SurfaceKind::external;
  UpAxis axes = UpAxis::none;  // which way the axes of the spin images point; none: along the normals
  std::size_t part = 0;        // its place in the feature vector: all parts are of one length
  float factor = 1.0F;         // what its encoding is multiplied by, before the draws of a part are added up
};

// All parts of the feature vector that describe gives of the object, in their order, draw by draw. Deterministic.
// Throws as prepare_object does.
std::vector<PreparedPart> prepare_parts(const Object& object, const Settings& settings);

}  // namespace spincat
