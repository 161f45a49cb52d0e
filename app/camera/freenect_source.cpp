#include "app/camera/freenect_source.h"

#include "spincat/error.h"

#ifdef SPINCAT_FREENECT
#include <libfreenect.h>
#include <libfreenect_sync.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "spincat/camera/source/calibration.h"
#endif

namespace spincat::app {

#ifdef SPINCAT_FREENECT
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kReadings = 2'048;  // of 11 bits; the last means none
// From the sensor's number to metres (S. Magnenat's fit, as OpenKinect's pages give it).
constexpr double kScale = 0.1236;
constexpr double kSlope = 2'842.5;
constexpr double kOffset = 1.1863;
constexpr double kFocal = 585.0;  // pixels, of the infrared camera

std::vector<float> metres_of_readings() {
  std::vector<float> metres(kReadings, 0.0F);
  for (int raw = 0; raw < kReadings - 1; ++raw) {
    const double z = kScale * std::tan(raw / kSlope + kOffset);
    metres[static_cast<std::size_t>(raw)] = z > 0.0 && z < 20.0 ? static_cast<float>(z) : 0.0F;
  }
  return metres;
}

// Whether there is one, asked so that libfreenect does not say its own words about it.
bool is_there() {
  freenect_context* context = nullptr;
  if (freenect_init(&context, nullptr) != 0) {
    return false;
  }
  freenect_set_log_level(context, FREENECT_LOG_FATAL);
  const int devices = freenect_num_devices(context);
  freenect_shutdown(context);
  return devices > 0;
}

class Kinect : public FrameSource {
 public:
  explicit Kinect(const Intrinsics& intrinsics) : intrinsics_(intrinsics) {}
  ~Kinect() override { freenect_sync_stop(); }
  Kinect(const Kinect&) = delete;
  Kinect& operator=(const Kinect&) = delete;

  std::optional<Frame> next() override {
    void* readings = nullptr;
    std::uint32_t stamp = 0;
    if (freenect_sync_get_depth(&readings, &stamp, 0, FREENECT_DEPTH_11BIT) != 0) {
      if (count_ == 0) {
        throw RunError("the Kinect cannot be opened: is another program using it?");
      }
      return {};  // it was unplugged
    }
    Frame frame;
    frame.name = std::to_string(count_++);
    frame.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    frame.intrinsics = intrinsics_;
    frame.image = DepthImage(kWidth, kHeight);
    const auto* raw = static_cast<const std::uint16_t*>(readings);
    for (std::size_t i = 0; i < frame.image.depth.size(); ++i) {
      frame.image.depth[i] = metres_[raw[i] & (kReadings - 1)];
    }
    return frame;
  }

 private:
  Intrinsics intrinsics_;
  std::vector<float> metres_ = metres_of_readings();
  std::size_t count_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

bool has_kinect() {
  return true;
}

std::unique_ptr<FrameSource> open_kinect(const FrameSettings& settings) {
  if (!is_there()) {
    throw RunError("no Kinect was found");
  }
  const Intrinsics own{kFocal, kFocal, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1)};
  return std::make_unique<Kinect>(settings.calibration ? read_calibration(*settings.calibration).intrinsics : own);
}

#else

bool has_kinect() {
  return false;
}

std::unique_ptr<FrameSource> open_kinect(const FrameSettings& /*settings*/) {
  throw InputError("freenect:", "this spincat was built without libfreenect (libfreenect-dev)");
}

#endif

}  // namespace spincat::app
