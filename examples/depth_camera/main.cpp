// Names the objects on a table, frame after frame of a depth camera: here of a recording, a folder of depth pictures.
// A driver's frames go the same way: fill a DepthImage, and hand it to look().
#include <spincat/spincat.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: depth_camera MODEL RECORDING\n");
    return 2;
  }
  try {
    const spincat::Model model = spincat::read_model(argv[1]);  // best trained by views
    spincat::RecogniserSettings settings;
    settings.reject = 0.2;
    spincat::Recogniser recogniser(model, settings, 2);
    const std::unique_ptr<spincat::FrameSource> camera = spincat::open_recording(argv[2], {});
    while (const std::optional<spincat::Frame> frame = camera->next()) {
      const spincat::SeenFrame seen = recogniser.look(frame->image, frame->intrinsics);
      std::printf("%s: %zu objects\n", frame->name.c_str(), seen.objects.size());
      for (const spincat::SeenObject& object : seen.objects) {
        if (!object.problem.empty()) {
          std::printf("  object %ju: %s\n", static_cast<std::uintmax_t>(object.id), object.problem.c_str());
          continue;
        }
        const char* const name = object.unknown ? "unknown" : model.categories()[object.fused.winner].c_str();
        std::printf("  object %ju at %.2f m: %s (confidence %.2f)\n", static_cast<std::uintmax_t>(object.id),
                    static_cast<double>(object.distance), name, object.fused_confidence);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "depth_camera: %s\n", error.what());
    return 1;
  }
}
