#include "spincat/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spincat/report/text_table.h"
#include "spincat/settings/setting_table.h"

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

std::string progress_line(std::string_view stage, std::size_t done, std::size_t total, double seconds,
                          std::size_t width) {
  constexpr std::size_t kStage = 20;
  constexpr std::size_t kWidestBar = 24;
  constexpr std::size_t kNarrowestBar = 6;
  std::string text = fmt::format("{}/{}", done, total);
  if (done > 0 && seconds > 0.0) {
    const double rate = static_cast<double>(done) / seconds;
    text += rate >= 1.0 ? fmt::format("  {:.{}f}/s", rate, rate < 100.0 ? 1 : 0)
                        : fmt::format("  {} each", human_seconds(1.0 / rate));
    text += fmt::format("  {} left", human_seconds(static_cast<double>(total - std::min(done, total)) / rate));
  }
  const std::string name = cut_in_the_middle(stage, kStage);
  const std::string head = name + std::string(kStage - text_width(name), ' ');
  const std::size_t taken = kStage + 1 + 2 + 1 + text_width(text);  // blanks and brackets
  if (width < taken + kNarrowestBar) {
    return cut_in_the_middle(name + " " + text, width);
  }
  const std::size_t bar = std::min(kWidestBar, width - taken);
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const auto filled = std::min(bar, static_cast<std::size_t>(share * static_cast<double>(bar)));
  return fmt::format("{} [{:#<{}}{:.<{}}] {}", head, "", filled, "", bar - filled, text);
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

// The settings of a stage that have an effect, as "spin points 256, neighbours 24".
std::string stage_text(const Settings& settings, SettingStage stage) {
  std::string text;
  for (const Setting& setting : setting_table()) {
    if (setting.stage == stage && (setting.no_effect == nullptr || setting.no_effect(settings).empty())) {
      std::string name(setting.name);
      std::ranges::replace(name, '_', ' ');
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, setting_text(settings, setting));
    }
  }
  return text;
}

constexpr std::pair<SettingStage, std::string_view> kStages[] = {{SettingStage::points, "points"},
                                                                 {SettingStage::images, "spin images"},
                                                                 {SettingStage::features, "features"},
                                                                 {SettingStage::training, "training"}};

std::string model_text(const Model& model, std::size_t width) {
  constexpr std::size_t kKey = 13;
  const Settings& s = model.settings();
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    const std::string fact = fmt::format("{:<{}}", key, kKey) + value;
    text += (width > 0 ? wrapped(fact, width, kKey) : fact) + "\n";
  };
  add("made by", printable(model.made_by()));
  add("trained on", printable(model.dataset()));
  std::string categories;
  for (std::size_t c = 0; c < model.categories().size(); ++c) {
    categories +=
        fmt::format("{}{} ({})", c > 0 ? ", " : "", printable(model.categories()[c]), model.object_counts()[c]);
  }
  add("categories", categories);
  add("judges", fmt::format("{} of {} features", model.judge_count(), model.feature_length()));
  add("preset", s.preset);
  for (const auto& [stage, name] : kStages) {
    add(name, stage_text(s, stage));
  }
  return text;
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
  defect(facts.is_mesh ? "vertices not finite" : "points not finite", facts.unfinite_points);
  defect(facts.is_mesh ? "repeated vertices" : "repeated points", facts.repeated_points);
  defect("unused vertices", facts.unused_vertices);
  defect("triangles without area", facts.flat_triangles);
  defect("repeated triangles", facts.repeated_triangles);
  defect("flipped triangles", facts.flipped_triangles);
  defect("dust triangles", facts.dust_triangles);
  defect("lone points", facts.lone_points);
  return table.str();
}

}  // namespace spincat
