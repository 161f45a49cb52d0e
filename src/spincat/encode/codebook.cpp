#include "spincat/encode/codebook.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spincat/geometry/parallel_for.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr Eigen::Index kChunk = 64;   // rows of one product; fixed, as in judge/gram.cpp: the order of sums must not
constexpr Eigen::Index kDepth = 128;  // depend on the machine
constexpr int kRounds = 15;

// The nearest word of each of the rows first, ..., first + count - 1.
void find_nearest(const Eigen::Ref<const Rows>& rows, Eigen::Index first, Eigen::Index count, const Rows& words,
                  const Eigen::VectorXf& half_lengths, std::vector<std::uint32_t>& nearest) {
  Eigen::MatrixXf products = Eigen::MatrixXf::Zero(words.rows(), count);
  for (Eigen::Index d = 0; d < rows.cols(); d += kDepth) {
    const Eigen::Index depth = std::min(kDepth, rows.cols() - d);
    for (Eigen::Index w = 0; w < words.rows(); w += kChunk) {
      const Eigen::Index some = std::min(kChunk, words.rows() - w);
      products.middleRows(w, some).noalias() +=
          words.block(w, d, some, depth) * rows.block(first, d, count, depth).transpose();
    }
  }
  products.colwise() -= half_lengths;  // x . w - |w|^2 / 2 is largest where |x - w| is smallest
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index at = 0;
    products.col(i).maxCoeff(&at);
    nearest[static_cast<std::size_t>(first + i)] = static_cast<std::uint32_t>(at);
  }
}

std::vector<std::uint32_t> nearest_words(const Eigen::Ref<const Rows>& rows, const Rows& words, int threads) {
  std::vector<std::uint32_t> nearest(static_cast<std::size_t>(rows.rows()));
  const Eigen::VectorXf half_lengths = 0.5F * words.rowwise().squaredNorm();
  const Eigen::Index chunks = (rows.rows() + kChunk - 1) / kChunk;
  const auto find = [&](Eigen::Index chunk) {
    const Eigen::Index first = chunk * kChunk;
    find_nearest(rows, first, std::min(kChunk, rows.rows() - first), words, half_lengths, nearest);
  };
  if (threads == 1) {  // no team of threads for each of many small tasks, which may run on threads already
    for (Eigen::Index chunk = 0; chunk < chunks; ++chunk) {
      find(chunk);
    }
    return nearest;
  }
  parallel_for(static_cast<std::size_t>(chunks), threads,
               [&](std::size_t chunk) { find(static_cast<Eigen::Index>(chunk)); });
  return nearest;
}

// k-means++: each further word is a sample drawn with a probability that grows with its squared distance to the words
// so far.
Rows first_words(const Rows& samples, std::size_t words, std::uint64_t seed) {
  Random random(seed);
  Rows chosen(static_cast<Eigen::Index>(words), samples.cols());
  std::vector<double> distance(static_cast<std::size_t>(samples.rows()), std::numeric_limits<double>::max());
  auto next = static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(samples.rows())));
  for (Eigen::Index w = 0; w < chosen.rows(); ++w) {
    chosen.row(w) = samples.row(next);
    double sum = 0.0;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const float to_word = (samples.row(static_cast<Eigen::Index>(i)) - chosen.row(w)).squaredNorm();
      distance[i] = std::min(distance[i], static_cast<double>(to_word));
      sum += distance[i];
    }
    double left = random.uniform() * sum;
    for (next = 0; next + 1 < samples.rows(); ++next) {
      left -= distance[static_cast<std::size_t>(next)];
      if (left < 0.0) {
        break;
      }
    }
  }
  return chosen;
}

// Moves each word to the mean of its samples; one that has none stays where it is.
void move_to_means(const Rows& samples, const std::vector<std::uint32_t>& nearest, Rows& words) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(words.cols(), words.rows());
  std::vector<double> counts(static_cast<std::size_t>(words.rows()), 0.0);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    sums.col(nearest[i]) += samples.row(static_cast<Eigen::Index>(i)).transpose().cast<double>();
    counts[nearest[i]] += 1.0;
  }
  for (Eigen::Index w = 0; w < words.rows(); ++w) {
    const double count = counts[static_cast<std::size_t>(w)];
    if (count > 0.0) {
      words.row(w) = (sums.col(w).transpose() / count).cast<float>();
    }
  }
}

}  // namespace

std::vector<float> Codebook::count(std::span<const float> local_features) const {
  const Eigen::Index rows = static_cast<Eigen::Index>(local_features.size()) / words.cols();
  const Eigen::Map<const Rows> local(local_features.data(), rows, words.cols());
  std::vector<float> shares(static_cast<std::size_t>(words.rows()), 0.0F);
  for (const std::uint32_t word : nearest_words(local, words, 1)) {
    shares[word] += 1.0F;
  }
  for (float& share : shares) {
    share = std::sqrt(share / static_cast<float>(std::max<Eigen::Index>(rows, 1)));
  }
  return shares;
}

Codebook learn_codebook(const Rows& samples, std::size_t words, std::uint64_t seed, int threads) {
  if (static_cast<std::size_t>(samples.rows()) <= words) {
    return {samples};
  }
  Codebook codebook{first_words(samples, words, seed)};
  std::vector<std::uint32_t> last;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::uint32_t> nearest = nearest_words(samples, codebook.words, threads);
    if (nearest == last) {
      break;
    }
    move_to_means(samples, nearest, codebook.words);
    last = std::move(nearest);
  }
  return codebook;
}

}  // namespace spincat
