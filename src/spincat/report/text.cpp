#include "spincat/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spincat/pipeline/setting_names.h"
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

// Rows are the truth, columns what objects were named; shares of each row in per cent, zeros as dots.
std::string confusion_matrix(const Evaluation& e) {
  const std::size_t n = e.categories.size();
  std::vector<Align> columns = {Align::left, Align::right};
  columns.insert(columns.end(), n, Align::right);
  TextTable table(columns);
  std::vector<std::string> head = {"truth \\ named as, %", "objects"};
  for (const std::string& category : e.categories) {
    head.push_back(printable(category));
  }
  table.add(std::move(head));
  for (std::size_t truth = 0; truth < n; ++truth) {
    const double total = row_total(e.confusion[truth]);
    std::vector<std::string> row = {printable(e.categories[truth]), fmt::format("{}", e.object_counts[truth])};
    for (const std::uint32_t count : e.confusion[truth]) {
      row.push_back(count == 0 ? "." : per_cent(count / total));
    }
    table.add(std::move(row));
  }
  return table.str();
}

std::string category_rates(const Evaluation& e) {
  TextTable table({Align::left, Align::right, Align::right});
  table.add({"category", "objects", "right"});
  for (std::size_t c = 0; c < e.categories.size(); ++c) {
    table.add({printable(e.categories[c]), fmt::format("{}", e.object_counts[c]), diagonal_share(e, c)});
  }
  return table.str();
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
    table.add({printable(e.categories[pair.truth]), printable(e.categories[pair.named]), per_cent(pair.share) + " %"});
  }
  return table.str();
}

std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    widest = std::max(widest, text_width(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  return widest;
}

std::string rate_text(const Rate& rate) {
  return fmt::format("{:.3f} ± {:.3f}", rate.mean, rate.deviation);
}

}  // namespace

std::string human_seconds(double seconds) {
  if (seconds < 0.9995) {
    return fmt::format("{:.{}f} ms", 1e3 * seconds, seconds < 0.0995 ? 1 : 0);
  }
  if (seconds < 59.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<long>(std::lround(seconds));
  return whole < 3600 ? fmt::format("{} min {} s", whole / 60, whole % 60)
                      : fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string evaluation_text(const Evaluation& e, std::size_t width) {
  std::string matrix = confusion_matrix(e);
  if (widest_line(matrix) > width) {
    matrix = category_rates(e) + "\n" + most_confused(e, 10);
  }
  const std::size_t objects = std::accumulate(e.object_counts.begin(), e.object_counts.end(), std::size_t{0});
  return fmt::format(
      "{}\n"
      "mean-class rate  {}   (mean and standard deviation over {} splits)\n"
      "overall rate     {}   ({} objects, {} categories, {})\n",
      matrix, rate_text(e.mean_class_rate), e.splits, rate_text(e.overall_rate), objects, e.categories.size(),
      human_seconds(e.wall_seconds));
}

std::string ballot_text(const Ballot& ballot, const std::vector<std::string>& categories) {
  std::vector<Vote> votes = ballot.votes;
  // The winner's judges first, then by strength.
  std::ranges::stable_sort(votes, [&](const Vote& p, const Vote& q) {
    const bool p_winner = p.choice() == ballot.winner;
    const bool q_winner = q.choice() == ballot.winner;
    return p_winner != q_winner ? p_winner : std::abs(p.margin) > std::abs(q.margin);
  });
  TextTable table({Align::left, Align::left, Align::left, Align::right});
  for (const Vote& vote : votes) {
    const std::uint32_t loser = vote.choice() == vote.category_a ? vote.category_b : vote.category_a;
    table.add({"   ", printable(categories[vote.choice()]), "not " + printable(categories[loser]),
               fmt::format("{:.2f}", std::abs(vote.margin))});
  }
  std::string text = table.str();
  if (ballot.tie_break != TieBreak::none) {
    text +=
        fmt::format("    a tie, broken by {}\n",
                    ballot.tie_break == TieBreak::margins ? "the sum of the margins" : "the order of the categories");
  }
  return text;
}

std::string model_text(const Model& model) {
  const Settings& s = model.settings;
  TextTable table({Align::left, Align::left});
  table.add({"made by", model.made_by});
  table.add({"trained on", printable(model.dataset)});
  std::string categories;
  for (std::size_t c = 0; c < model.categories.size(); ++c) {
    categories += fmt::format("{}{} ({})", c > 0 ? ", " : "", printable(model.categories[c]), model.object_counts[c]);
  }
  table.add({"categories", categories});
  table.add({"judges", fmt::format("{} of {} features", model.judges.size(), model.feature_length())});
  table.add({"preset", fmt::format("{}, seed {}, {} stretched copies of each object", s.preset, s.seed, s.copies)});
  table.add({"surface", fmt::format("{}, {} points, {} spin points", name_of(s.prepare.surface), s.prepare.points,
                                    s.prepare.spin_points)});
  table.add(
      {"spin images",
       fmt::format("{}, width {}, bin size {} {}, support angle {}, {} binning", name_of(s.spin.convention),
                   s.spin.image_width, s.spin.bin_size, name_of(s.bin_size_unit),
                   s.spin.angle_test == AngleTest::soft ? std::string("soft") : fmt::format("{}", s.spin.support_angle),
                   name_of(s.spin.binning))});
  table.add({"encoding", s.encoding});
  return table.str();
}

std::string object_text(const ObjectFacts& facts) {
  TextTable table({Align::left, Align::left});
  table.add({"kind", facts.is_mesh ? "mesh" : facts.has_normals ? "point cloud with normals" : "point cloud"});
  table.add({facts.is_mesh ? "vertices" : "points", fmt::format("{}", facts.points)});
  if (facts.is_mesh) {
    table.add({"triangles", fmt::format("{}", facts.triangles)});
  }
  const Vec3 size = facts.high - facts.low;
  table.add({"size", fmt::format("{:.6g} x {:.6g} x {:.6g}", size.x(), size.y(), size.z())});
  if (facts.is_mesh) {
    table.add({"area", fmt::format("{:.6g}", facts.area)});
  }
  table.add({"resolution", fmt::format("{:.6g}", facts.resolution)});
  const auto defect = [&](const char* name, std::size_t count) {
    if (count > 0) {
      table.add({name, fmt::format("{}", count)});
    }
  };
  defect(facts.is_mesh ? "repeated vertices" : "repeated points", facts.repeated_points);
  defect("unused vertices", facts.unused_vertices);
  defect("triangles without area", facts.flat_triangles);
  defect("repeated triangles", facts.repeated_triangles);
  return table.str();
}

}  // namespace spincat
