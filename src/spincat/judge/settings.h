// How judges are taught.
#pragma once

namespace spincat {

struct JudgeSettings {
  double c = 200.0;           // C of the C-SVM, > 0: the price of an error in training
  bool class_weights = true;  // C of a category's objects is multiplied by N / (k n): N objects, n of this category, k
                              // categories, so that a large category does not outvote a small one

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

}  // namespace spincat
