// Bags of features: typical local features learned from training objects, and how often an object has each of them.
//
// Source: G. Csurka et al., "Visual categorization with bags of keypoints", ECCV workshop 2004; square roots of the
// counts as R. Arandjelovic and A. Zisserman, CVPR 2012.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spincat {

// How many local features an object is reduced to. A fixed number, so that the memory of a table is bounded by its
// rows.
inline constexpr std::size_t kLocalFeatures = 256;

// Typical local features ("words").
struct Codebook {
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> words;  // k x d; none: no codebook is used

  bool empty() const { return words.rows() == 0; }
  // How many numbers an object has before they are counted: kLocalFeatures d.
  std::size_t input_length() const { return kLocalFeatures * static_cast<std::size_t>(words.cols()); }

  // The square roots of the shares of the words among local features (d numbers each, one after the other), each
  // counted for its nearest word, the first of equally near ones: k numbers of length 1. Deterministic.
  std::vector<float> count(std::span<const float> local_features) const;
};

// Learns `words` words from samples (n x d, finite): k-means, begun by k-means++ (Arthur and Vassilvitskii, 2007) and
// ended after 15 rounds or when nothing moves any more. All samples when there are no more than `words` of them. The
// result depends on the samples, their order, `words` and `seed` alone, not on `threads`. Precondition: n > 0.
Codebook learn_codebook(const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& samples,
                        std::size_t words, std::uint64_t seed, int threads);

}  // namespace spincat
