#include "spincat/judge/pairwise_svm.h"

#include <libsvm/svm.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace spincat {
namespace {

struct ModelDeleter {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};

// The nodes of a thread's problems, one after the other: memory that the system clears anew for each problem of some
// thousand rows would take longer than its solution.
class NodeMemory {
 public:
  svm_node* room_for(std::size_t count) {
    if (count > size_) {
      nodes_.reset();  // before the larger one is taken
      size_ = 0;
      nodes_ = std::make_unique_for_overwrite<svm_node[]>(count);
      size_ = count;
    }
    return nodes_.get();
  }

 private:
  std::unique_ptr<svm_node[]> nodes_;
  std::size_t size_ = 0;
};

// A Gram matrix in libsvm's layout: for each object a node with its serial number (1, 2, ...), then one node for each
// kernel value. Only one at a time lives in a thread.
class PrecomputedKernel {
 public:
  explicit PrecomputedKernel(const Eigen::MatrixXf& gram) {
    thread_local NodeMemory memory;
    const auto n = static_cast<std::size_t>(gram.rows());
    svm_node* const nodes = memory.room_for(n * (n + 2));
    objects_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      svm_node* node = objects_[i] = nodes + i * (n + 2);
      *node++ = {0, static_cast<double>(i + 1)};
      for (std::size_t j = 0; j < n; ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const auto column = static_cast<Eigen::Index>(i);
        *node++ = {static_cast<int>(j + 1), gram(row, column)};
      }
      *node = {-1, 0.0};
    }
  }

  svm_node** objects() { return objects_.data(); }

 private:
  std::vector<svm_node*> objects_;
};

svm_parameter parameters(std::span<int, 2> labels, std::span<double, 2> weights) {
  svm_parameter p{};
  p.svm_type = C_SVC;
  p.kernel_type = PRECOMPUTED;
  p.cache_size = 64.0;  // MB, for the kernel columns that the solver keeps
  p.eps = 1e-3;
  p.C = 1.0;  // the whole of C is in the weights
  p.nr_weight = 2;
  p.weight_label = labels.data();
  p.weight = weights.data();
  p.shrinking = 1;
  return p;
}

}  // namespace

PairwiseSvm train_pairwise_svm(const Eigen::MatrixXf& gram, std::uint32_t first_count, double c_first,
                               double c_second) {
  // libsvm writes to standard output unless it is told where else; the library never prints.
  static const bool quiet = (svm_set_print_string_function([](const char*) {}), true);
  static_cast<void>(quiet);

  std::vector<double> y(static_cast<std::size_t>(gram.rows()), -1.0);
  std::fill_n(y.begin(), first_count, 1.0);  // libsvm's sign follows the label that it meets first
  PrecomputedKernel kernel(gram);
  std::array<int, 2> labels = {1, -1};
  std::array<double, 2> weights = {c_first, c_second};
  const svm_parameter parameter = parameters(labels, weights);
  const svm_problem problem{static_cast<int>(y.size()), y.data(), kernel.objects()};
  const std::unique_ptr<svm_model, ModelDeleter> model(svm_train(&problem, &parameter));

  PairwiseSvm svm;
  svm.bias = -model->rho[0];
  for (int s = 0; s < model->l; ++s) {  // libsvm keeps the order of the objects within each category
    svm.object.push_back(static_cast<std::uint32_t>(model->sv_indices[s] - 1));
    svm.coefficient.push_back(model->sv_coef[0][s]);
  }
  return svm;
}

}  // namespace spincat
