// Draws the overview in the README: for each object its points, three of its spin images, the judges' votes and the
// name. Everything in it is computed here, by a trained model; README.md says how to make it again.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "panels.h"
#include "sight.h"
#include "spincat/classify/classify.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/prepare/facts.h"
#include "spincat/prepare/resolution.h"
#include "spincat/spin/spin_images.h"
#include "svg.h"

namespace {

namespace fs = std::filesystem;

constexpr double kWidth = 1200.0;
constexpr double kHeader = 96.0;
constexpr double kRow = 156.0;
constexpr double kFooter = 8.0;
constexpr double kImage = 126.0;  // size of a drawn spin image
constexpr std::size_t kImages = 3;
constexpr double kColumns[] = {36.0, 292.0, 736.0, 996.0};  // left edges of objects, images, votes and names

// What the road from a file to a name produces on its way.
struct Road {
  std::string caption;
  spincat::PreparedObject prepared;
  spincat::SpinImages images;
  spincat::Classification classification;
};

// 12345 -> "12,345".
std::string with_commas(std::size_t number) {
  return number < 1000 ? std::to_string(number) : fmt::format("{},{:03}", with_commas(number / 1000), number % 1000);
}

Road travel(const spincat::Model& model, const fs::path& file) {
  const spincat::Object object = spincat::read_object(file);
  const spincat::ObjectFacts facts = spincat::facts_of(object);
  const spincat::Settings& settings = model.settings();
  Road road;
  road.caption =
      fmt::format("{}, {} {}", file.filename().string(), with_commas(facts.is_mesh ? facts.triangles : facts.points),
                  facts.is_mesh ? "triangles" : "points");
  auto [prepared, params] = spincat::prepare_object(object, settings);
  road.images = spincat::make_spin_images(prepared.surface, prepared.spin_points, params);
  road.prepared = std::move(prepared);
  road.classification = spincat::classify(model, object);
  return road;
}

// A dot's size in units of the object: so wide that dots as close as most are cover the surface.
double dot_size(const spincat::OrientedPoints& surface) {
  std::vector<spincat::Vec3> points;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    points.push_back(surface.position(i).cast<double>());
  }
  return 2.0 * spincat::cloud_resolution(points);
}

// Draws the object; returns which spin points are marked in it.
std::vector<std::size_t> draw_object(Svg& svg, const Road& road, double azimuth, double top) {
  const spincat::OrientedPoints& surface = road.prepared.surface;
  const Sight sight =
      look_at(surface, road.prepared.spin_points, azimuth, {kColumns[0] + 8.0, top + 10.0, 200.0, kRow - 42.0});
  const std::vector<std::size_t> shown = far_apart(sight.points, surface.size(), kImages);
  std::vector<SeenPoint> marked;
  for (const std::size_t k : shown) {
    marked.push_back(sight.points[surface.size() + k]);
  }
  draw_points(svg, std::span(sight.points).first(surface.size()), dot_size(surface) * sight.scale, marked);
  svg.text(kColumns[0] + 106.0, top + kRow - 12.0, road.caption, {12.5, kFaint, false, "middle"});
  return shown;
}

void draw_road(Svg& svg, const spincat::Model& model, const Road& road, double azimuth, double top) {
  const std::vector<std::size_t> shown = draw_object(svg, road, azimuth, top);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    draw_spin_image(svg, road.images.image(shown[i]), road.images.shape(),
                    kColumns[1] + static_cast<double>(i) * (kImage + 14.0), top + (kRow - kImage) / 2.0, kImage, i);
  }
  const spincat::Classification& answer = road.classification;
  draw_votes(svg, answer.ballot, model.categories(), {kColumns[2], top + 10.0, 210.0, kRow - 20.0});
  draw_name(svg, model.categories()[answer.ballot.winner], answer.confidence,
            {kColumns[3], top, kWidth - 40.0 - kColumns[3], kRow});
}

void draw_header(Svg& svg, const spincat::Model& model, const Road& example) {
  const std::size_t judges = model.categories().size() * (model.categories().size() - 1) / 2;
  const std::string notes[] = {
      fmt::format("seen from outside: {} points", with_commas(example.prepared.surface.size())),
      fmt::format("{} per object, three of them shown", example.images.count()),
      fmt::format("{} judges, one for each pair", judges), "and how sure that is"};
  const std::string titles[] = {"mesh or cloud", "spin images", "judges vote", "name"};
  for (std::size_t i = 0; i < 4; ++i) {
    svg.text(kColumns[i], 46.0, titles[i], {22.0, kInk, true});
    svg.text(kColumns[i], 68.0, notes[i], {14.0, kFaint});
    if (i > 0) {
      svg.path(
          fmt::format("M{} 38h18m-6.5 -6.5l6.5 6.5l-6.5 6.5", short_number(kColumns[i] - 36.0)),
          "fill=\"none\" stroke=\"#8492a6\" stroke-width=\"2.4\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    }
  }
}

// FILE or FILE@AZIMUTH.
struct Wish {
  fs::path file;
  double azimuth = 30.0;
};

Wish parse_wish(const std::string& argument) {
  const std::size_t at = argument.rfind('@');
  return at == std::string::npos ? Wish{argument} : Wish{argument.substr(0, at), std::stod(argument.substr(at + 1))};
}

void draw_overview(const fs::path& model_file, const fs::path& picture, const std::vector<Wish>& wishes) {
  const spincat::Model model = spincat::read_model(model_file);
  const double height = kHeader + kRow * static_cast<double>(wishes.size()) + kFooter;
  Svg svg(kWidth, height, "From a mesh or a cloud over spin images and the judges' votes to a name");
  // A background of its own: readable on light and dark pages.
  svg.rect(1, 1, kWidth - 2, height - 2, "rx=\"18\" fill=\"#fbfcfe\" stroke=\"#d5dce7\" stroke-width=\"1.5\"");
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Road road = travel(model, wishes[i].file);
    const double top = kHeader + kRow * static_cast<double>(i);
    if (i == 0) {
      draw_header(svg, model, road);
    }
    svg.path(fmt::format("M36 {}H{}", top - 4.0, kWidth - 36.0), "stroke=\"#e3e8f0\" stroke-width=\"1.2\"");
    draw_road(svg, model, road, wishes[i].azimuth, top);
  }
  spincat::write_file_atomically(picture, svg.finish());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: overview_picture MODEL PICTURE.svg OBJECT[@AZIMUTH]...\n");
    return 2;
  }
  try {
    std::vector<Wish> wishes;
    for (int i = 3; i < argc; ++i) {
      wishes.push_back(parse_wish(argv[i]));
    }
    draw_overview(argv[1], argv[2], wishes);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "overview_picture: %s\n", error.what());
    return 1;
  }
}
