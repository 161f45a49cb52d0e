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

// The paper's: the rows of each image one after the other, the images one after the other, in the order of the spin
// points: M W W numbers, scaled to length 1 together; one block.
std::unique_ptr<Encoding> make_concatenation();

// Our default: each image is reduced to a pyramid of three smaller ones (the inner quarter at full resolution, the
// inner half and the whole, coarser), square roots are taken, and the mean and the standard deviation of every bin over
// the spin points of each of four bands is one feature, each image a block; docs/how-it-works/encoding.md. Needs an
// image width divisible by 8 in the johnson convention.
std::unique_ptr<Encoding> make_pooled_pyramid();

// The mean of all images, scaled to length 1: the simplest thing that forgets the order of the spin points. One block.
std::unique_ptr<Encoding> make_mean_image();

// The images of kLocalFeatures spin points one by one, each reduced to at most 10 x 10 cells a channel, as square roots
// of shares of the surface points: local features, to be counted by a codebook that was learned from training objects
// (codebook.h) before judges see them.
std::unique_ptr<Encoding> make_bag_of_features();

// The encoding called `name`. Throws InputError that lists the names when there is none.
std::unique_ptr<Encoding> make_encoding(std::string_view name);
const std::vector<std::string>& encoding_names();

}  // namespace spincat
