// Frames of a depth camera as arrays, and what is seen in them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "settings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

namespace fs = std::filesystem;

const char* name_of(FrameStatus status) {
  constexpr const char* kNames[] = {"objects", "empty_table", "no_table", "few_readings", "wrong_units"};
  return kNames[static_cast<std::size_t>(status)];
}

// H x W numbers; `unit` of them are a metre.
DepthImage image_of(const py::handle& given, double unit) {
  constexpr Range kUnit{0.0, 1e9, true};
  check_range("units_per_metre", unit, kUnit);
  const py::array array = any_array(given, "depth", "an array of shape (H, W)");
  constexpr py::ssize_t kLongestSide = 16'384;
  if (array.ndim() != 2 || array.shape(0) == 0 || array.shape(1) == 0) {
    throw InputError("depth: expected an array of shape (H, W), found " + shape_text(array));
  }
  if (array.shape(0) > kLongestSide || array.shape(1) > kLongestSide) {
    throw InputError("depth: expected 16384 rows and columns at most, found " + shape_text(array));
  }
  const py::array_t<double, py::array::c_style | py::array::forcecast> depths(array);
  DepthImage image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const double* from = depths.data();
  for (float& depth : image.depth) {
    depth = static_cast<float>(*from++ / unit);
  }
  return image;
}

Intrinsics intrinsics_of(const std::array<double, 4>& given) {
  Intrinsics intrinsics{given[0], given[1], given[2], given[3]};
  intrinsics.validate();
  return intrinsics;
}

// 3 x 3: a row for each axis.
py::array_t<float> axes_of(const OrientedBox& box) {
  py::array_t<float> axes({3, 3});
  std::copy_n(box.axes.data(), 9, axes.mutable_data());  // columns one after the other
  return axes;
}

SceneKind scene_of(const std::string& name) {
  if (name == "auto") {
    return SceneKind::automatic;
  }
  if (name != "table" && name != "floor") {
    throw InputError("scene: expected 'auto', 'table' or 'floor', found '" + name + "'");
  }
  return name == "table" ? SceneKind::table : SceneKind::floor;
}

// Python's class Recogniser. Two threads of Python may call it: it looks at one frame after the other.
class FrameReader {
 public:
  FrameReader(Model model, const RecogniserSettings& settings, int threads)
      : model_(std::move(model)), recogniser_(model_, settings, threads_of(threads)) {}

  py::dict frame(const py::object& depth, const std::array<double, 4>& intrinsics, double unit) {
    const DepthImage image = image_of(depth, unit);
    const Intrinsics camera = intrinsics_of(intrinsics);
    const SeenFrame seen = run_work(py::none(), [&](Telling&) {
      const std::lock_guard lock(mutex_);
      return recogniser_.look(image, camera);
    });
    return frame_of(seen, image);
  }

 private:
  py::dict object_of(const SeenObject& object) const {
    py::dict result;
    result["id"] = object.id;
    result["segment"] = object.segment.id;
    result["pixels"] = object.segment.pixels;
    result["box"] =
        py::make_tuple(object.segment.left, object.segment.top, object.segment.right, object.segment.bottom);
    const Eigen::Vector3f& centre = object.segment.centre;
    result["centre"] = array_of<float>({centre.x(), centre.y(), centre.z()});
    const OrientedBox& box = object.segment.box;
    result["box3d"] = py::make_tuple(array_of<float>({box.centre.x(), box.centre.y(), box.centre.z()}), axes_of(box),
                                     array_of<float>({box.size.x(), box.size.y(), box.size.z()}));
    result["height"] = object.segment.height;
    result["distance"] = object.distance;
    result["cut"] = object.segment.cut;
    result["problem"] = object.problem;
    if (object.problem.empty()) {
      const std::string& guess = model_.categories()[object.fused.winner];
      result["name"] = object.unknown ? "unknown" : guess;
      result["best_guess"] = guess;
      result["confidence"] = object.fused_confidence;
      result["known"] = object.fused_known;
      result["frames"] = object.fused.ballots;
    }
    return result;
  }

  py::dict frame_of(const SeenFrame& seen, const DepthImage& image) const {
    py::dict result;
    result["status"] = name_of(seen.status);
    result["median_depth"] = seen.median_depth;
    result["table"] = py::none();
    py::array_t<float> outline({static_cast<py::ssize_t>(seen.segmentation.outline.size()), py::ssize_t{3}});
    float* to = outline.mutable_data();
    for (const Eigen::Vector3f& corner : seen.segmentation.outline) {
      to = std::copy_n(corner.data(), 3, to);
    }
    result["outline"] = outline;
    if (seen.table) {
      const Eigen::Vector3f& normal = seen.table->normal;
      result["table"] = array_of<float>({normal.x(), normal.y(), normal.z(), seen.table->offset});
    }
    py::array_t<std::uint16_t> ids({image.height, image.width});
    std::fill_n(ids.mutable_data(), ids.size(), std::uint16_t{0});
    std::ranges::copy(seen.segmentation.ids, ids.mutable_data());
    result["ids"] = ids;
    py::list objects;
    for (const SeenObject& object : seen.objects) {
      objects.append(object_of(object));
    }
    result["objects"] = objects;
    return result;
  }

  Model model_;
  std::mutex mutex_;
  Recogniser recogniser_;
};

std::unique_ptr<FrameReader> make_reader(const Model& model, const py::dict& wanted, int threads) {
  RecogniserSettings settings;
  if (!wanted["reject"].is_none()) {
    settings.reject = wanted["reject"].cast<double>();
  }
  if (!wanted["up"].is_none()) {
    const auto up = wanted["up"].cast<std::array<float, 3>>();
    const Eigen::Vector3f direction(up[0], up[1], up[2]);
    if (!direction.allFinite() || direction.isZero(0.0F)) {
      throw InputError("up: expected a direction");
    }
    settings.table.up = direction.stableNormalized();
  }
  settings.segment.split = wanted["split"].cast<bool>() ? SegmentSplit::concave : SegmentSplit::none;
  settings.table.scene = scene_of(wanted["scene"].cast<std::string>());
  settings.segment.least_area = wanted["least_area"].cast<float>();
  settings.segment.least_height = wanted["least_height"].cast<float>();
  settings.segment.most_height = wanted["most_height"].cast<float>();
  settings.summed_frames = wanted["summed_frames"].cast<int>();
  settings.validate();
  return std::make_unique<FrameReader>(model, settings, threads);
}

// A recording, frame by frame; threads of Python that share it get one frame each.
class Recording {
 public:
  explicit Recording(const fs::path& place) : source_(open_recording(place, {})) {}

  std::optional<Frame> next() {
    const std::lock_guard lock(mutex_);
    return source_->next();
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<FrameSource> source_;
};

py::object next_frame(Recording& recording) {
  const std::optional<Frame> frame = run_work(py::none(), [&](Telling&) { return recording.next(); });
  if (!frame) {
    throw py::stop_iteration();
  }
  py::array_t<float> depth({frame->image.height, frame->image.width});
  std::ranges::copy(frame->image.depth, depth.mutable_data());
  const Intrinsics& camera = frame->intrinsics;
  return py::make_tuple(depth, py::make_tuple(camera.fx, camera.fy, camera.cx, camera.cy), frame->name, frame->time);
}

}  // namespace

void bind_camera(py::module_& module) {
  py::class_<FrameReader>(module, "Recogniser").def(py::init(&make_reader)).def("frame", &FrameReader::frame);
  py::class_<Recording>(module, "Recording")
      .def(py::init<const fs::path&>())
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &next_frame);
}

}  // namespace spincat::python
