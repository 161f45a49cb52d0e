#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "spincat/report/text.h"
#include "spincat/report/text_table.h"

namespace spincat {
namespace {

std::string per_cent(double share) {
  return fmt::format("{:.0f}", 100.0 * share);
}

double row_total(const std::vector<std::uint32_t>& row) {
  return std::accumulate(row.begin(), row.end(), 0.0);
}

std::string diagonal_share(const Evaluation& e, std::size_t c) {
  const double total = row_total(e.confusion[c]);
  return total > 0.0 ? per_cent(e.confusion[c][c] / total) + " %" : "-";
}

constexpr std::size_t kLongestName = 28;  // in lists

std::string listed_name(const Evaluation& e, std::size_t c) {
  return cut_in_the_middle(printable(e.categories[c]), kLongestName);
}

// Terminal colours of a share of right names, and of wrong ones.
std::string_view right_style(double share) {
  return share >= 0.9 ? "1;32" : share >= 0.5 ? "32" : "33";
}
std::string_view wrong_style(double share) {
  return share >= 0.2 ? "1;31" : "31";
}

Cell matrix_cell(std::uint32_t count, double total, bool on_diagonal) {
  if (count == 0) {
    return {".", "2"};
  }
  const double share = count / total;
  return {per_cent(share), on_diagonal ? right_style(share) : wrong_style(share)};
}

// Rows are the truth, columns what objects were named; shares of each row in per cent, zeros as dots. Names are cut to
// `longest` columns.
TextTable confusion_matrix(const Evaluation& e, std::size_t longest) {
  const std::size_t n = e.categories.size();
  std::vector<Align> columns = {Align::left, Align::right};
  columns.insert(columns.end(), n, Align::right);
  TextTable table(columns);
  std::vector<Cell> head = {"truth \\ named as, %", "objects"};
  for (const std::string& category : e.categories) {
    head.emplace_back(cut_in_the_middle(printable(category), longest));
  }
  table.add(std::move(head));
  for (std::size_t truth = 0; truth < n; ++truth) {
    const double total = row_total(e.confusion[truth]);
    std::vector<Cell> row = {cut_in_the_middle(printable(e.categories[truth]), std::max<std::size_t>(longest, 18)),
                             fmt::format("{}", e.object_counts[truth])};
    for (std::size_t named = 0; named < n; ++named) {
      row.push_back(matrix_cell(e.confusion[truth][named], total, named == truth));
    }
    table.add(std::move(row));
  }
  return table;
}

std::string category_rates(const Evaluation& e, bool colours) {
  TextTable table({Align::left, Align::right, Align::right});
  table.add({"category", "objects", "right"});
  for (std::size_t c = 0; c < e.categories.size(); ++c) {
    const double total = row_total(e.confusion[c]);
    table.add({listed_name(e, c), fmt::format("{}", e.object_counts[c]),
               total > 0.0 ? Cell(diagonal_share(e, c), right_style(e.confusion[c][c] / total)) : Cell("-")});
  }
  return table.str(colours);
}

std::string most_confused(const Evaluation& e, std::size_t most) {
  struct Confused {
    std::size_t truth;
    std::size_t named;
    double share;
  };
  std::vector<Confused> pairs;
  for (std::size_t i = 0; i < e.categories.size(); ++i) {
    for (std::size_t j = 0; j < e.categories.size(); ++j) {
      if (i != j && e.confusion[i][j] > 0) {
        pairs.push_back({i, j, e.confusion[i][j] / row_total(e.confusion[i])});
      }
    }
  }
  if (pairs.empty()) {
    return {};
  }
  std::ranges::stable_sort(pairs, std::ranges::greater{}, &Confused::share);
  pairs.resize(std::min(most, pairs.size()));
  TextTable table({Align::left, Align::left, Align::right});
  table.add({"most often confused", "named as", "of its objects"});
  for (const Confused& pair : pairs) {
    table.add({listed_name(e, pair.truth), listed_name(e, pair.named), per_cent(pair.share) + " %"});
  }
  return table.str();
}

// The matrix with names as long as `width` allows, or what stands in its place.
std::string matrix_or_lists(const Evaluation& e, std::size_t width, bool colours) {
  constexpr std::size_t kWhole = 1'000;
  for (const std::size_t longest :
       {kWhole, std::size_t{20}, std::size_t{16}, std::size_t{12}, std::size_t{10}, std::size_t{8}, std::size_t{6}}) {
    const TextTable matrix = confusion_matrix(e, longest);
    if (widest_line(matrix.str()) <= width) {
      return matrix.str(colours);
    }
  }
  return category_rates(e, colours) + "\n" + most_confused(e, 10);
}

std::string rate_text(const Evaluation& e, const Rate& rate) {
  const std::string spread = e.protocol == Protocol::splits ? fmt::format(" ± {:.3f}", rate.deviation) : "";
  return fmt::format("{:.3f}{}   95 % interval {:.3f} to {:.3f}", rate.mean, spread, rate.interval.low,
                     rate.interval.high);
}

std::string protocol_text(const Evaluation& e) {
  switch (e.protocol) {
    case Protocol::leave_one_out:
      return "each object named by judges trained on all others";
    case Protocol::across:
      return fmt::format("tested on {} objects of {}",
                         std::accumulate(e.test_object_counts.begin(), e.test_object_counts.end(), std::size_t{0}),
                         printable(e.test_dataset));
    case Protocol::splits:
      break;
  }
  const std::size_t all = static_cast<std::size_t>(e.splits) * std::max<std::size_t>(1, e.split_seeds.size());
  return fmt::format("mean and standard deviation over {} splits", all);
}

// The mean-class rate of each seed, where there are several.
std::string seeds_text(const Evaluation& e) {
  if (e.seeds.size() < 2) {
    return {};
  }
  std::vector<std::string> rates;
  for (const SeedRates& seed : e.seeds) {
    rates.push_back(fmt::format("{:.3f}", seed.mean_class_rate.mean));
  }
  return fmt::format("seeds {}  {}   (mean-class rate over {} splits each)\n", fmt::join(e.split_seeds, ", "),
                     fmt::join(rates, "  "), e.splits);
}

// What more views of an object bring.
std::string views_text(const Evaluation& e) {
  if (e.views.empty()) {
    return {};
  }
  TextTable table({Align::right, Align::right, Align::right});
  table.add({"views summed", "mean-class rate", "overall rate"});
  for (const ViewsRates& of : e.views) {
    table.add({fmt::format("{}", of.views), fmt::format("{:.3f}", of.mean_class_rate),
               fmt::format("{:.3f}", of.overall_rate)});
  }
  return table.str() + "\n";
}

std::string confidence_text(const Evaluation& e) {
  if (!e.confidence) {
    return {};
  }
  std::string text = fmt::format("confidence       {:.3f} on average; area under the curve {:.3f} for right or wrong",
                                 e.confidence->mean_confidence, e.confidence->right_or_wrong);
  if (e.confidence->unknown_objects > 0) {
    text += fmt::format(", {:.3f} for known or unknown ({} unknown objects)", e.confidence->known_or_unknown,
                        e.confidence->unknown_objects);
  }
  text += fmt::format("\nturned away      {:.1f} % of the tested objects", 100.0 * e.confidence->turned_away);
  if (e.confidence->unknown_objects > 0) {
    text += fmt::format(", {:.1f} % of the unknown objects", 100.0 * e.confidence->strangers_turned_away);
  }
  return text + "\n";
}

}  // namespace

std::string evaluation_text(const Evaluation& e, std::size_t width, bool colours) {
  constexpr std::size_t kIndent = 17;
  const std::size_t objects = std::accumulate(e.object_counts.begin(), e.object_counts.end(), std::size_t{0});
  const std::string last = fmt::format("{} objects, {} categories, {}, {}", objects, e.categories.size(),
                                       protocol_text(e), human_seconds(e.wall_seconds));
  const std::size_t lines = std::max<std::size_t>(width, 40);  // of prose
  return fmt::format(
      "{}\n{}"
      "mean-class rate  {}\n"
      "overall rate     {}\n"
      "{}{}"
      "{}\n",
      matrix_or_lists(e, width, colours), views_text(e), rate_text(e, e.mean_class_rate), rate_text(e, e.overall_rate),
      wrapped(seeds_text(e), lines, kIndent), wrapped(confidence_text(e), lines, kIndent), wrapped(last, lines));
}

}  // namespace spincat
