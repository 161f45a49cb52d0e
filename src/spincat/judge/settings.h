// How judges are trained.
#pragma once

#include <limits>

#include "spincat/range.h"

#pragma GCC visibility push(default)
namespace spincat {

// How alike two feature vectors x and y are.
enum class KernelKind {
  linear,  // x . y: judges fold into one matrix, a model holds no training objects
  rbf,     // the mean over the encoding's blocks b of exp(-|x_b - y_b|^2 / m_b); kernel.h
};

// The C that suits a kernel, found on several data sets: 200 (linear), 3 (rbf).
double default_c(KernelKind kernel);

struct JudgeSettings {
  KernelKind kernel = KernelKind::linear;
  double c = 200.0;           // C of the C-SVM: the price of an error in training; see default_c
  bool class_weights = true;  // C of a category's objects is multiplied by N / (k n): N objects, n of this category, k
                              // categories, so that a large category does not outvote a small one

  static constexpr Range kC{0.0, std::numeric_limits<double>::infinity(), true};

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

}  // namespace spincat
#pragma GCC visibility pop
