#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "spincat/error.h"
#include "spincat/evaluate/evaluate.h"

namespace spincat {
namespace {

// What there is to know of a form beside how it is made.
struct FormRow {
  TestForm form;
  std::string_view name;
  std::optional<double> noise;      // where it has any: how much, unless another is asked for
  std::optional<int> cloud_points;  // where it is a cloud
};

constexpr int kUsualPoints = 2048;

constexpr std::array<FormRow, 9> kForms = {{{TestForm::as_is, "as-is", {}, {}},
                                            {TestForm::turned, "turned", {}, {}},
                                            {TestForm::cloud, "cloud", 0.01, kUsualPoints},
                                            {TestForm::noisy_mesh, "noisy-mesh", 0.005, {}},
                                            {TestForm::dense_mesh, "dense-mesh", 0.01, {}},
                                            {TestForm::holes, "holes", {}, {}},
                                            {TestForm::inner, "inner", {}, {}},
                                            {TestForm::cut, "cut", 0.0, kUsualPoints},
                                            {TestForm::sparse, "sparse", 0.0, 300}}};

const FormRow& row_of(TestForm form) {
  return *std::ranges::find(kForms, form, &FormRow::form);
}

}  // namespace

std::string_view name_of(TestForm form) {
  return row_of(form).name;
}

TestForm test_form_named(std::string_view name) {
  std::string known;
  for (const FormRow& row : kForms) {
    if (row.name == name) {
      return row.form;
    }
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError(fmt::format("form '{}' is not known (one of {})", name, known));
}

double TestOptions::used_noise() const {
  return noise.value_or(row_of(form).noise.value_or(0.0));
}

int TestOptions::used_cloud_points() const {
  return cloud_points.value_or(row_of(form).cloud_points.value_or(kUsualPoints));
}

bool TestOptions::has_noise() const {
  return row_of(form).noise.has_value();
}

bool TestOptions::has_cloud_points() const {
  return row_of(form).cloud_points.has_value();
}

void TestOptions::validate() const {
  const double amount = used_noise();
  if (!(amount >= 0.0 && amount <= 1.0)) {
    throw InputError(fmt::format("noise {} is out of range (0 to 1)", amount));
  }
  const int points = used_cloud_points();
  if (points < 1 || points > 10'000'000) {
    throw InputError(fmt::format("number of cloud points {} is out of range (1 to 10000000)", points));
  }
}

}  // namespace spincat
