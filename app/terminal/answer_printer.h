// The answers of classify, as people or programs want them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"

namespace spincat::app {

struct AnswerLook {
  bool json = false;
  bool votes = false;            // what every judge said, too
  std::optional<double> reject;  // objects that are less known are not named; none: the model's choice
  bool rejects(const Classification& c, const Model& by) const { return c.known < reject.value_or(by.least_known()); }
};

// An error without the name of its file, for those who tell that besides.
std::string_view without_file(std::string_view error, std::string_view file);

// Prints to standard output (errors of people's files to standard error). On a terminal rows are as wide as it is, and
// long names are cut in the middle; elsewhere columns are as wide as the widest file and category.
class AnswerPrinter {
 public:
  // `model` must outlive this.
  AnswerPrinter(const Model& model, const std::vector<std::string>& files, const AnswerLook& look);

  void print(const std::string& file, const Answer& answer);

 private:
  void fit(std::size_t columns);
  void print_error(const std::string& file, const std::string& error);
  void print_text(const std::string& file, const Classification& c);
  void print_row(const std::string& file, const std::string& category, const std::string& confidence,
                 const std::string& votes, const std::string& runner_up, const std::string& time) const;
  std::string name(std::uint32_t category) const;

  const Model& model_;
  AnswerLook look_;
  std::size_t file_width_ = 4;
  std::size_t category_width_ = 8;
  bool head_printed_ = false;
};

}  // namespace spincat::app
