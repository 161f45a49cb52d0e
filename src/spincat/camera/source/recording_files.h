// The files of a recording: its frames, and what lies with them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spincat/camera/source/depth_list.h"

namespace spincat {

inline constexpr double kFramesPerSecond = 30.0;  // where a recording tells no times

inline constexpr const char* kOwnCalibration = "camera.txt";

struct RecordingFiles {
  std::filesystem::path folder;  // of the frames' names
  FrameList frames;              // never empty
  bool is_one_file = false;      // that the user named
  std::optional<std::filesystem::path> calibration;
  bool is_of_tum = false;          // by the lists that lie with the frames
  std::vector<std::string> notes;  // what was passed over or chosen
};

// Looks for the recording at a place: see open_recording. Throws InputError naming the file or folder.
RecordingFiles find_recording(const std::filesystem::path& place);

}  // namespace spincat
