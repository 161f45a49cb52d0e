#include "panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

namespace {

constexpr std::string_view kWinner = "#2563c9";
constexpr std::string_view kOther = "#a9b6c9";
constexpr std::string_view kEmpty = "#e6ebf2";

// A numbered disc.
void draw_mark(Svg& svg, double x, double y, double radius, std::size_t number) {
  svg.circle(x, y, radius, fmt::format("fill=\"{}\" stroke=\"#fff\" stroke-width=\"1.5\"", mark_colour(number)));
  svg.text(x, y + 0.36 * 1.35 * radius, std::to_string(number + 1), {1.35 * radius, "#fff", true, "middle"});
}

// All cells of an image that have one level, as horizontal strokes in units of cells.
std::string cells_of_level(std::span<const int> levels, std::size_t columns, int level) {
  std::string commands;
  for (std::size_t begin = 0; begin < levels.size();) {
    if (levels[begin] != level) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end % columns != 0 && levels[end] == level) {
      ++end;
    }
    commands += fmt::format("M{} {}h{}", begin % columns, begin / columns, end - begin);
    begin = end;
  }
  return commands;
}

constexpr int kLevels = 24;

// The level of each cell, 0 for an empty one.
std::vector<int> levels_of(std::span<const float> image, const spincat::SpinImageShape& shape) {
  const std::size_t cells = shape.rows * shape.columns;
  std::vector<double> sums(cells, 0.0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    sums[i % cells] += image[i];
  }
  const double largest = *std::max_element(sums.begin(), sums.end());
  std::vector<int> levels;
  for (const double sum : sums) {
    levels.push_back(largest > 0.0 ? static_cast<int>(std::ceil(kLevels * std::sqrt(sum / largest))) : 0);
  }
  return levels;
}

}  // namespace

std::string_view mark_colour(std::size_t number) {
  constexpr std::array<std::string_view, 3> colours{"#d1480f", "#0b7f63", "#8a3fb0"};
  return colours[number % colours.size()];
}

void draw_points(Svg& svg, std::span<const SeenPoint> points, double size, std::span<const SeenPoint> marked) {
  constexpr int kShades = 10;
  constexpr double kSlab = 6.0;  // pixels of depth; dots within a slab are sorted by shade, so that they share a path
  std::map<std::tuple<bool, double, int>, std::string> paths;
  for (const SeenPoint& point : points) {
    const int shade = std::min(kShades - 1, static_cast<int>(point.shade * kShades));
    const auto key =
        point.hidden ? std::tuple(false, 0.0, 0) : std::tuple(true, std::floor(point.depth / kSlab), shade);
    paths[key] += fmt::format("M{} {}h.01", short_number(point.x), short_number(point.y));
  }
  svg.begin_group(fmt::format("fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\"", short_number(size)));
  for (const auto& [key, commands] : paths) {
    const auto [seen, slab, shade] = key;
    const double t = (shade + 0.5) / kShades;
    svg.path(commands, seen ? fmt::format("stroke=\"{}\"", oklch(0.22 + 0.64 * t, 0.07 - 0.02 * t, 255.0))
                            : "stroke=\"#dfe4ec\" stroke-width=\"2\"");
  }
  svg.end_group();
  for (std::size_t i = 0; i < marked.size(); ++i) {
    draw_mark(svg, marked[i].x, marked[i].y, 7.5, i);
  }
}

void draw_spin_image(Svg& svg, std::span<const float> image, const spincat::SpinImageShape& shape, double x, double y,
                     double size, std::size_t number) {
  const std::vector<int> levels = levels_of(image, shape);
  svg.rect(x, y, size, size, fmt::format("fill=\"{}\"", heat_colour(0.0)));
  svg.begin_group(fmt::format(
      "transform=\"translate({} {}) scale({:.4g} {:.4g}) translate(0 .5)\" fill=\"none\" stroke-width=\"1.04\"",
      short_number(x), short_number(y), size / static_cast<double>(shape.columns),
      size / static_cast<double>(shape.rows)));
  for (int level = 1; level <= kLevels; ++level) {
    const std::string commands = cells_of_level(levels, shape.columns, level);
    if (!commands.empty()) {
      svg.path(commands, fmt::format("stroke=\"{}\"", heat_colour(static_cast<double>(level) / kLevels)));
    }
  }
  svg.end_group();
  svg.rect(x - 1.5, y - 1.5, size + 3, size + 3,
           fmt::format("rx=\"3\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\"", mark_colour(number)));
  draw_mark(svg, x + 2, y + 2, 8.5, number);
}

void draw_votes(Svg& svg, const spincat::Ballot& ballot, const std::vector<std::string>& categories, const Box& box) {
  constexpr double kLabel = 66.0;
  constexpr double kGap = 4.0;
  const double judges = static_cast<double>(categories.size()) - 1.0;  // of one category
  const double row = box.height / static_cast<double>(categories.size());
  const double width = (box.width - kLabel - 22.0 - kGap * (judges - 1.0)) / judges;
  const double height = std::min(13.0, row - 6.0);
  for (std::size_t c = 0; c < categories.size(); ++c) {
    const bool winner = c == ballot.winner;
    const double middle = box.y + (static_cast<double>(c) + 0.5) * row;
    const TextStyle style{14.5, winner ? kWinner : kFaint, winner, "end"};
    svg.text(box.x + kLabel - 10.0, middle + 5.0, categories[c], style);
    for (int j = 0; j < static_cast<int>(judges); ++j) {
      const std::string_view colour = j >= static_cast<int>(ballot.count[c]) ? kEmpty : (winner ? kWinner : kOther);
      svg.rect(box.x + kLabel + j * (width + kGap), middle - height / 2.0, width, height,
               fmt::format("rx=\"2.5\" fill=\"{}\"", colour));
    }
    svg.text(box.x + box.width, middle + 5.0, std::to_string(ballot.count[c]), style);
  }
}

void draw_name(Svg& svg, const std::string& name, double confidence, const Box& box) {
  const double middle = box.y + box.height / 2.0;
  svg.text(box.x, middle - 2.0, name, {36.0, kInk, true});
  svg.rect(box.x, middle + 14.0, box.width, 6.0, fmt::format("rx=\"3\" fill=\"{}\"", kEmpty));
  svg.rect(box.x, middle + 14.0, box.width * confidence, 6.0, fmt::format("rx=\"3\" fill=\"{}\"", kWinner));
  svg.text(box.x, middle + 40.0,
           confidence >= 0.995 ? "confidence > 0.99" : fmt::format("confidence {:.2f}", confidence), {14.5, kFaint});
}
