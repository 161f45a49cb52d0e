// Encodings: how the spin images of an object become one feature vector.
//
// Every encoding works in two steps, so that images can be made and forgotten block by block, on any thread or machine:
// `accumulate` adds what a block of images contributes to a row of sums, and `finish` turns the sums into the feature
// vector. block_sums.h adds the sums of blocks in an order that does not depend on where they were made.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/encode/feature_vector.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/spin/spin_images.h"

namespace spincat {

class Encoding {
 public:
  virtual ~Encoding() = default;

  // As in settings and model files.
  virtual std::string_view name() const = 0;

  // Whether the number of sums is the same for any number of spin points.
  virtual bool pools() const { return true; }

  // Throws InputError when this encoding cannot work on such images.
  virtual void check(const SpinImageParams& params) const = 0;

  // Whether its feature vectors are local features, which a codebook has to count before judges see them.
  virtual bool gives_local_features() const { return false; }

  // Called once for an object, before its blocks: what has to be known of all its points. The object must outlive the
  // result.
  class ObjectSums;
  virtual std::unique_ptr<ObjectSums> begin(const OrientedPoints& surface, const OrientedPoints& spin_points,
                                            const SpinImageParams& params) const = 0;
};

// The sums of one object on their way to a feature vector.
class Encoding::ObjectSums {
 public:
  virtual ~ObjectSums() = default;

  // How many sums a block's contribution has.
  virtual std::size_t size() const = 0;

  // Adds the block's contribution to `sums` (size() numbers, zero before the first block). Const: blocks may be
  // accumulated into separate sums at the same time.
  virtual void accumulate(const SpinImageBlock& block, std::span<double> sums) const = 0;

  // Deterministic in `sums`.
  virtual FeatureVector finish(std::span<const double> sums) const = 0;

  // For encodings whose features are sums over the images, once the lengths, means and deviations in them are held at
  // what they are in `sums` (those of all blocks): adds to shares[first + k] what image k of the block gives to
  // weights . finish(sums).values. The shares of all images add up to that product. False, and nothing done, where the
  // encoding knows no such shares.
  virtual bool add_contributions(const SpinImageBlock& /*block*/, std::span<const double> /*sums*/,
                                 std::span<const float> /*weights*/, std::span<double> /*shares*/) const {
    return false;
  }

  // What `finish` would give without image k of the block, all that `begin` knew of the points held; `sums` are those
  // of all blocks. Encodings of a fixed number of images get an empty one instead, unless they say otherwise.
  // Deterministic.
  virtual FeatureVector finish_without(const SpinImageBlock& block, std::size_t k, std::span<const double> sums) const;

 protected:
  // What image k of the block gives to the sums.
  std::vector<double> sums_of_image(const SpinImageBlock& block, std::size_t k) const;
};

// The encoding called `name`, one of encodings.inc; its file says what it does. Throws InputError that lists the names
// when there is none.
std::unique_ptr<Encoding> make_encoding(std::string_view name);
// Of all encodings, the default first.
const std::vector<std::string>& encoding_names();

}  // namespace spincat
