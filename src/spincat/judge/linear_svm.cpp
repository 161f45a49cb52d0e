#include "spincat/judge/linear_svm.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

constexpr double kSolved = 0.01;
constexpr int kMostRounds = 1000;
constexpr std::uint64_t kOrder = 0xd0a1;  // seed of the order in which rows are visited: any will do

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Largest and smallest projected gradient of a round. At the solution both are 0.
struct Gradients {
  double largest = -kInfinity;
  double smallest = kInfinity;

  void add(double gradient) {
    largest = std::max(largest, gradient);
    smallest = std::min(smallest, gradient);
  }
  bool are_solved() const { return largest - smallest <= kSolved; }
};

class DualCoordinateDescent {
 public:
  DualCoordinateDescent(const FeatureMatrix& rows, std::uint32_t first_count, double c_first, double c_second)
      : rows_(rows),
        first_count_(first_count),
        c_{c_first, c_second},
        alpha_(static_cast<std::size_t>(rows.rows()), 0.0),
        w_(Eigen::RowVectorXf::Zero(rows.cols())),
        order_(alpha_.size()),
        random_(kOrder) {
    std::iota(order_.begin(), order_.end(), 0U);
    curvature_.reserve(alpha_.size());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      curvature_.push_back(1.0 + static_cast<double>(rows.row(i).squaredNorm()));
    }
  }

  PairwiseSvm solve() {
    Border border;
    std::size_t active = order_.size();
    for (int round = 0; round < kMostRounds; ++round) {
      const Gradients gradients = visit(border, active);
      if (!gradients.are_solved()) {
        border = {gradients.largest > 0.0 ? gradients.largest : kInfinity,
                  gradients.smallest < 0.0 ? gradients.smallest : -kInfinity};
      } else if (active == order_.size()) {
        break;
      } else {  // look at all rows again
        active = order_.size();
        border = {};
      }
    }
    return result();
  }

 private:
  // Rows at a bound whose gradient is beyond these will stay there and are visited no more.
  struct Border {
    double above = kInfinity;
    double below = -kInfinity;
  };

  double sign(std::uint32_t i) const { return i < first_count_ ? 1.0 : -1.0; }
  double most(std::uint32_t i) const { return i < first_count_ ? c_[0] : c_[1]; }

  // One round over the first `active` rows of the order. Rows that need no more visits are put behind them.
  Gradients visit(const Border& border, std::size_t& active) {
    for (std::size_t k = active; k > 1; --k) {
      std::swap(order_[k - 1], order_[random_.below(k)]);
    }
    Gradients gradients;
    for (std::size_t k = 0; k < active;) {
      const std::uint32_t i = order_[k];
      const double gradient = sign(i) * (static_cast<double>(w_.dot(rows_.row(i))) + bias_) - 1.0;
      const bool is_lowest = alpha_[i] == 0.0;
      const bool is_highest = alpha_[i] == most(i);
      if ((is_lowest && gradient > border.above) || (is_highest && gradient < border.below)) {
        std::swap(order_[k], order_[--active]);
        continue;
      }
      const double projected = is_lowest ? std::min(gradient, 0.0) : is_highest ? std::max(gradient, 0.0) : gradient;
      gradients.add(projected);
      if (projected != 0.0) {
        move(i, gradient);
      }
      ++k;
    }
    return gradients;
  }

  // To the minimum along one coordinate, within its bounds.
  void move(std::uint32_t i, double gradient) {
    const double alpha = std::clamp(alpha_[i] - gradient / curvature_[i], 0.0, most(i));
    const double change = sign(i) * (alpha - alpha_[i]);
    alpha_[i] = alpha;
    w_ += static_cast<float>(change) * rows_.row(i);
    bias_ += change;
  }

  PairwiseSvm result() const {
    PairwiseSvm svm;
    for (std::uint32_t i = 0; i < alpha_.size(); ++i) {
      if (alpha_[i] > 0.0) {
        svm.object.push_back(i);
        svm.coefficient.push_back(sign(i) * alpha_[i]);
      }
    }
    svm.bias = bias_;
    return svm;
  }

  const FeatureMatrix& rows_;
  const std::uint32_t first_count_;
  const double c_[2];
  std::vector<double> alpha_;
  std::vector<double> curvature_;  // of the objective along each coordinate
  Eigen::RowVectorXf w_;           // sum of sign alpha row
  double bias_ = 0.0;
  std::vector<std::uint32_t> order_;
  Random random_;
};

}  // namespace

PairwiseSvm train_linear_svm(const FeatureMatrix& rows, std::uint32_t first_count, double c_first, double c_second) {
  return DualCoordinateDescent(rows, first_count, c_first, c_second).solve();
}

}  // namespace spincat
