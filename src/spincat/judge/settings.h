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

struct JudgeSettings {
  KernelKind kernel = KernelKind::linear;
  int dimensions = 0;  // of the small space that judges learn in (whitening.h), at most; 0: they see the features
                       // themselves, as with the rbf kernel they must
  double c = 200.0;    // C of the C-SVM: the price of an error in training; see default_c
  bool class_weights = true;  // C of a category's objects is multiplied by N / (k n): N objects, n of this category, k
                              // categories, so that a large category does not outvote a small one

  static constexpr Range kDimensions{0, 10'000};
  static constexpr Range kC{0.0, std::numeric_limits<double>::infinity(), true};

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

// The C that suits such judges, found on several data sets: 3 (rbf), 10 (linear in a small space), 200 (linear).
double default_c(const JudgeSettings& settings);

}  // namespace spincat
#pragma GCC visibility pop
