#include "app/terminal/answer_printer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "app/terminal/messages.h"
#include "app/terminal/terminal.h"
#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/report/text.h"
#include "spincat/report/text_table.h"

namespace spincat::app {
namespace {

constexpr std::size_t kRunnerUp = 9;                   // "runner-up"
constexpr std::size_t kOtherColumns = 10 + 5 + 8 + 1;  // confidence, votes, time, a blank
constexpr std::size_t kBetween = 5 * 2;                // six columns
constexpr std::size_t kLeastFile = 12;
constexpr std::size_t kLeastCategory = 8;

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text_width(text) ? width - text_width(text) : 0, ' ');
}

}  // namespace

std::string_view without_file(std::string_view error, std::string_view file) {
  const bool named = error.starts_with(file) && error.substr(file.size()).starts_with(": ");
  return named ? error.substr(file.size() + 2) : error;
}

AnswerPrinter::AnswerPrinter(const Model& model, const std::vector<std::string>& files, const AnswerLook& look)
    : model_(model), look_(look) {
  for (const std::string& file : files) {
    file_width_ = std::max(file_width_, text_width(printable(file)));
  }
  for (const std::string& category : model.categories()) {
    category_width_ = std::max(category_width_, text_width(printable(category)));
  }
  if (is_terminal(STDOUT_FILENO)) {
    fit(terminal_width(STDOUT_FILENO, 80));
  }
}

// First long categories give way, then long files.
void AnswerPrinter::fit(std::size_t columns) {
  const std::size_t fixed = kOtherColumns + kBetween;
  const std::size_t free = columns > fixed ? columns - fixed : 0;
  const std::size_t least_file = std::min(file_width_, free / 2);
  category_width_ = std::clamp((free - least_file) / 2, kLeastCategory, std::max(category_width_, kLeastCategory));
  const std::size_t taken = category_width_ + std::max(category_width_, kRunnerUp);
  file_width_ = std::min(file_width_, std::max(kLeastFile, free > taken ? free - taken : 0));
}

void AnswerPrinter::print(const std::string& file, const Answer& answer) {
  if (!answer.classification) {
    print_error(file, answer.error);
  } else if (look_.json) {
    fmt::print("{}\n", classification_json(file, *answer.classification, model_, look_.votes,
                                           look_.rejects(*answer.classification, model_)));
  } else {
    print_text(file, *answer.classification);
  }
}

void AnswerPrinter::print_error(const std::string& file, const std::string& error) {
  if (look_.json) {
    fmt::print("{}\n", error_json(file, std::string(without_file(error, file))));
  } else {
    std::fflush(stdout);  // keeps both streams in order where they meet
    message(error);
  }
}

void AnswerPrinter::print_text(const std::string& file, const Classification& c) {
  const StageSeconds& s = c.seconds;
  if (!head_printed_) {  // not before there is a row: a run of errors alone needs none
    print_row("file", "category", "confidence", "votes", "runner-up", "time");
    head_printed_ = true;
  }
  print_row(cut_in_the_middle(printable(file), file_width_),
            look_.rejects(c, model_) ? "unknown" : name(c.ballot.winner),
            fmt::format("{:.2f}{}", c.confidence, c.kind_mismatch.empty() ? "" : "*"),
            fmt::format("{}/{}", c.ballot.count[c.ballot.winner], model_.categories().size() - 1),
            name(c.ballot.runner_up), human_seconds(s.read + s.prepare + s.spin + s.encode + s.judge));
  if (look_.rejects(c, model_)) {
    fmt::print("    most like {}, but hardly of any category (known {:.2f})\n", name(c.ballot.winner), c.known);
  }
  if (look_.votes) {
    fmt::print("{}", ballot_text(c.ballot, model_.categories()));
  }
}

void AnswerPrinter::print_row(const std::string& file, const std::string& category, const std::string& confidence,
                              const std::string& votes, const std::string& runner_up, const std::string& time) const {
  fmt::print("{}  {}  {:>10}  {:>5}  {}  {:>8}\n", padded(file, file_width_), padded(category, category_width_ + 1),
             confidence, votes, padded(runner_up, std::max(category_width_, kRunnerUp)), time);
}

std::string AnswerPrinter::name(std::uint32_t category) const {
  return cut_in_the_middle(printable(model_.categories()[category]), category_width_);
}

}  // namespace spincat::app
