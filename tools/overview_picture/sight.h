// Looking at oriented points: where they fall in a picture and which of them are hidden.
#pragma once

#include <cstddef>
#include <vector>

#include "spincat/geometry/oriented_points.h"

// One point as the viewer sees it. Objects stand on their x-z plane, y upwards.
struct SeenPoint {
  double x = 0.0;      // to the right and
  double y = 0.0;      // downwards, in pixels of the box
  double depth = 0.0;  // towards the viewer
  double shade = 0.0;  // 0 turned away from the light to 1 turned to it
  bool hidden = false;
};

// The box of a picture that an object is fitted into.
struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};

// What the viewer sees: the points, and how many pixels a unit of the object has.
struct Sight {
  std::vector<SeenPoint> points;
  double scale = 1.0;
};

// Looks at the points from `azimuth` degrees around the y axis and a little above, without perspective, so large that
// `surface` fills the box. The points are those of `surface` followed by those of `marks`; only `surface` hides
// anything.
Sight look_at(const spincat::OrientedPoints& surface, const spincat::OrientedPoints& marks, double azimuth,
              const Box& box);

// `count` points that can be seen and lie far from each other: each the furthest, in the picture, from those before it.
// `first` is the index of the first candidate; the results count from there. Fewer when not as many can be seen.
std::vector<std::size_t> far_apart(const std::vector<SeenPoint>& points, std::size_t first, std::size_t count);
