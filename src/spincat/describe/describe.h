// One object to its feature vector: prepare, spin, encode.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "spincat/encode/feature_vector.h"
#include "spincat/geometry/object.h"
#include "spincat/prepare/prepare.h"
#include "spincat/settings/settings.h"
#include "spincat/spin/params.h"

#pragma GCC visibility push(default)
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

// The seed of the points of training copy number `k` of an object; 0: of the object itself, as it is named later.
std::uint64_t points_seed(const Settings& settings, int k = 0);

// The feature vector of an object, from points drawn by `seed`. On this thread unless `encoder` says otherwise.
// Deterministic. Adds the time spent to `seconds` where one is given. Throws InputError (without a file name) when the
// object has no extent.
FeatureVector describe(const Object& object, const Settings& settings, std::uint64_t seed,
                       StageSeconds* seconds = nullptr, const EncodePrepared& encoder = {});

// The same from the points by which the object is named.
inline FeatureVector describe(const Object& object, const Settings& settings) {
  return describe(object, settings, points_seed(settings));
}

// The first stage of describe by itself, for those who want the spin images: the first part's first draw.
// Deterministic. Throws as describe does, and when the bin size is out of range for this object.
Preparation prepare_object(const Object& object, const Settings& settings, std::uint64_t seed);
inline Preparation prepare_object(const Object& object, const Settings& settings) {
  return prepare_object(object, settings, points_seed(settings));
}

// Which way the axes of a part's spin images point.
enum class SpinAxes {
  normals,  // along the normals of the spin points
  radial,   // away from the mean of the surface points
  x,        // up, which is this axis of the file
  y,
  z,
};

// The word for it: "normals", "radial", "x", "y" or "z".
std::string_view name_of(SpinAxes axes);

// What one part of an object's feature vector is made of, in one draw of its points.
struct PreparedPart {
  Preparation preparation;
  SurfaceKind surface = SurfaceKind::external;
  SpinAxes axes = SpinAxes::normals;
  std::size_t part = 0;  // its place in the feature vector: all parts are of one length
  float factor = 1.0F;   // what its encoding is multiplied by, before the draws of a part are added up
};

// All parts of the feature vector that describe gives of the object, in their order, draw by draw. Deterministic.
// Throws as prepare_object does.
std::vector<PreparedPart> prepare_parts(const Object& object, const Settings& settings);

}  // namespace spincat
#pragma GCC visibility pop
