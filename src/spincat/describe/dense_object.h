// One dense object over many threads and ranks: its spin points are shared out.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "spincat/encode/feature_vector.h"
#include "spincat/execution.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/parallel/task.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/spin/params.h"
#include "spincat/spin/spin_images.h"

namespace spincat {

// The names of its two kinds of work, as ranks tell each other.
inline constexpr const char* kImagesTasks = "spin images of one object";
inline constexpr const char* kSumsTasks = "sums of one object";

// Points whose spin images are wanted. What is referred to must outlive the call.
struct DenseObject {
  const OrientedPoints& surface;
  const OrientedPoints& spin_points;
  const SpinImageParams& params;
};

// Makes the image of every spin point, on all threads and ranks of the farm, and hands them on in order, on the calling
// thread: the images of the spin points `first`, `first` + 1, ... one after the other. The same bytes as
// make_spin_images. `tick` gets the number of spin points that are done.
void make_spin_images(TaskFarm& farm, const DenseObject& object,
                      const std::function<void(std::size_t first, std::span<const float> images)>& consume,
                      const TaskFarm::Tick& tick);

// The feature vector of the object, as describe() makes it. With WorkSplit::return_images no journal keeps the images.
// Throws InputError when there is no such encoding or it cannot work on such images.
FeatureVector encode_object(TaskFarm& farm, const DenseObject& object, std::string_view encoding, WorkSplit split,
                            const TaskFarm::Tick& tick);

// The work of both, for other ranks.
Work make_images_work(std::string_view context);
Work make_sums_work(std::string_view context);

}  // namespace spincat
