// spincat_camera_figures: the numbers of docs/results/accuracy.md, as JSON; experiments/camera-figures calls it.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "figures.h"

int main(int argc, char** argv) {
  CLI::App app("Measures how well and how fast spincat names what a depth camera sees.");
  std::filesystem::path dataset;
  spincat::DatasetOptions data_options;
  std::filesystem::path kinect;
  std::filesystem::path scratch = "build/camera";
  spincat::bench::SceneOptions options;
  std::vector<std::filesystem::path> labelled;
  int first_label = 20;
  int rooms = 0;
  bool scenes = false;
  double speed = 0.0;
  app.add_option("--objects", dataset, "data set to make scenes of, whose y axis points up");
  app.add_option("--models", data_options.models, "as spincat's --models");
  app.add_option("--map", data_options.category_map, "as spincat's --map");
  app.add_flag("--scenes", scenes, "rendered scenes of the objects");
  app.add_option("--speed", speed, "so many seconds of each timing");
  app.add_option("--kinect", kinect, "folder of the real scenes (mosd-dev)");
  app.add_option("--labelled", labelled, "folders of depth pictures with labels (camera.txt in each)");
  app.add_option("--first-label", first_label, "that is a part's, in --labelled");
  app.add_option("--rooms", rooms, "so many rendered rooms, with false objects counted");
  app.add_option("--scratch", scratch, "folder for generated shapes");
  app.add_option("--views", options.views, "of each object");
  app.add_option("--count", options.scenes, "scenes of each fifth of the objects");
  app.add_option("--seed", options.seed, "of the scenes");
  app.add_option("--threads", options.threads, "to learn on");
  CLI11_PARSE(app, argc, argv);
  constexpr int kKeep = 1 << 28;  // bytes: as the command has it
  mallopt(M_MMAP_THRESHOLD, kKeep);
  mallopt(M_TRIM_THRESHOLD, kKeep);
  try {
    spincat::bench::Json report = spincat::bench::Json::object();
    if (!kinect.empty()) {
      report["kinect"] = spincat::bench::kinect_figures(kinect, scratch / "shapes", options.views, options.threads);
    }
    for (const std::filesystem::path& folder : labelled) {
      report["labelled"][folder.string()] = spincat::bench::labelled_figures(folder, first_label);
    }
    if (rooms > 0) {
      report["rooms"] = spincat::bench::room_figures(rooms, options.seed);
    }
    if (scenes) {
      report["scenes"] = spincat::bench::scene_figures(spincat::read_dataset({dataset}, data_options), options);
    }
    if (speed > 0.0) {
      report["speed"] = spincat::bench::speed_figures(spincat::read_dataset({dataset}, data_options), options, speed);
    }
    std::cout << report.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "spincat_camera_figures: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
