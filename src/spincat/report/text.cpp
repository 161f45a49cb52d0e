#include "spincat/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spincat/pipeline/setting_names.h"
#include "spincat/report/text_table.h"

namespace spincat {

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
