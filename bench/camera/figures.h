// What docs/results/accuracy.md tells in numbers, one function a table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/geometry/object.h"

namespace spincat::bench {

using Json = nlohmann::ordered_json;

struct SceneOptions {
  int views = 12;
  int scenes = 24;  // of each fifth
  UpAxis up = UpAxis::y;
  std::uint64_t seed = 1;
  int threads = 1;
};

// Judges learn from four fifths of the objects, and scenes are made of the rest, five times over: plane, objects found,
// false ones, names on one frame and over eight.
Json scene_figures(const Dataset& objects, const SceneOptions& options);

// Judges that learned from generated boxes and round shapes alone, on the segments of real scenes (mOSD, as
// shared data has it). `scratch`: where the shapes are written.
Json kinect_figures(const std::filesystem::path& scenes, const std::filesystem::path& scratch, int views, int threads);

// How many labelled parts of the pictures below a folder are found, by each way to split, and how often the table is
// missed over 20 seeds. Labels from `first_label` on are parts.
Json labelled_figures(const std::filesystem::path& folder, int first_label);

// The same for so many rendered rooms of blocks and tins on a table before a wall.
Json room_figures(int count, std::uint64_t seed);

// Frames in memory of scenes with so many objects, all found in every frame: milliseconds and frames a second.
Json speed_figures(const Dataset& objects, const SceneOptions& options, double seconds);

}  // namespace spincat::bench
