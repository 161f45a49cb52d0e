#include "spincat/camera/source/recording_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "spincat/camera/source/depth_png.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/files/system_error_text.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// Names in the order in which people count: frame9 before frame10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number = [&](const std::string& text, std::size_t& at) {
        const std::size_t first = std::min(text.find_first_not_of('0', at), text.size());
        at = first;
        while (at < text.size() && is_digit(text[at])) {
          ++at;
        }
        return text.substr(first, at - first);
      };
      const std::string x = number(a, i);
      const std::string y = number(b, j);
      if (x != y) {
        return x.size() != y.size() ? x.size() < y.size() : x < y;
      }
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

// A list without its last line where that was cut off, by a power cut or a full disk, while it was written: it has no
// end, and it is no line of a list or names no file that is there. What is left of one frame is no reason to refuse all
// others; and the last line of many a list that is whole has no end.
std::string_view without_cut_line(std::string_view text, const fs::path& folder) {
  const std::size_t last = text.find_last_of("\r\n") + 1;  // 0: there is but one line
  if (last == 0 || last == text.size()) {
    return text;
  }
  try {
    const FrameList frames = parse_depth_list(text.substr(last));
    if (frames.empty() || fs::exists(status_of(folder / frames.front().file))) {
      return text;
    }
  } catch (const InputError&) {
  }
  return text.substr(0, last);
}

FrameList listed_files(const fs::path& list) {
  expect_regular(list);
  return naming_file(list, [&] {
    const std::string text = read_file(list);
    return parse_depth_list(without_cut_line(text, list.parent_path()));
  });
}

// Calls `see` with each entry of the folder.
template <class See>
void for_each_entry(const fs::path& folder, const See& see) {
  std::error_code error;
  fs::directory_iterator next(folder, error);
  for (; !error && next != fs::directory_iterator(); next.increment(error)) {
    see(*next);
  }
  if (error) {
    throw InputError(folder.string(), "cannot be read: " + system_error_text(error.value()));
  }
}

// The files of a folder that may be frames.
struct Candidates {
  std::vector<std::string> depths;  // and what cannot be told: who reads them says what is wrong
  std::vector<std::string> clouds;
  std::size_t few_bits = 0;
  std::size_t colours = 0;
  std::size_t others = 0;  // of 16 bits without "depth" in their names, where some have it

  bool any() const { return !depths.empty() || !clouds.empty(); }
};

std::string lower_case(std::string text) {
  for (char& c : text) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

bool is_named_depth(const fs::path& path) {
  return lower_case(path.filename().string()).find("depth") != std::string::npos;
}

PictureKind kind_of_file(const fs::directory_entry& entry) {
  std::error_code error;
  if (!entry.is_regular_file(error)) {
    return PictureKind::unknown;
  }
  try {
    return kind_of_picture(read_file(entry.path(), kKindBytes));
  } catch (const InputError&) {
    return PictureKind::unknown;
  }
}

Candidates candidates_in(const fs::path& folder) {
  Candidates found;
  for_each_entry(folder, [&](const fs::directory_entry& entry) {
    const std::string extension = lower_extension(entry.path());
    if (extension == ".pcd") {
      found.clouds.push_back(entry.path().filename().string());
    } else if (extension == ".png") {
      const PictureKind kind = kind_of_file(entry);
      found.colours += kind == PictureKind::colours ? 1 : 0;
      found.few_bits += kind == PictureKind::few_bits ? 1 : 0;
      if (kind == PictureKind::depths || kind == PictureKind::unknown) {
        found.depths.push_back(entry.path().filename().string());
      }
    }
  });
  const auto named = static_cast<std::size_t>(std::ranges::count_if(found.depths, is_named_depth));
  if (named > 0 && named < found.depths.size()) {  // masks and labels may have 16 bits, too
    found.others = std::erase_if(found.depths, std::not_fn(is_named_depth));
  }
  return found;
}

// "11 pictures in colours, 1 picture of 8 bits or fewer"; empty where there are none.
std::string other_pictures(const Candidates& found) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) {
      parts.push_back(fmt::format("{} picture{} {}", count, count == 1 ? "" : "s", what));
    }
  };
  add(found.colours, "in colours");
  add(found.few_bits, "of 8 bits or fewer");
  add(found.others, "without \"depth\" in the name");
  return fmt::format("{}", fmt::join(parts, ", "));
}

FrameList frames_of(Candidates found) {
  std::vector<std::string>& files = found.depths.empty() ? found.clouds : found.depths;
  std::ranges::sort(files, natural_less);
  FrameList frames;
  for (std::string& file : files) {
    frames.push_back({std::move(file), static_cast<double>(frames.size()) / kFramesPerSecond});
  }
  return frames;
}

// The names of the sub-folders, in natural order.
std::vector<std::string> folders_in(const fs::path& folder) {
  std::vector<std::string> names;
  for_each_entry(folder, [&](const fs::directory_entry& entry) {
    std::error_code error;
    if (entry.is_directory(error)) {
      names.push_back(entry.path().filename().string());
    }
  });
  std::ranges::sort(names, natural_less);
  return names;
}

enum class Content { nothing, other_pictures, frames };

Content content_of(const fs::path& folder) {
  try {
    const Candidates found = candidates_in(folder);
    return found.any() || fs::exists(status_of(folder / "depth.txt")) ? Content::frames
           : found.colours + found.few_bits > 0                       ? Content::other_pictures
                                                                      : Content::nothing;
  } catch (const InputError&) {  // one that we may not look into holds nothing for us
    return Content::nothing;
  }
}

// The sub-folder that holds the depths: "depth", or the only one with that in its name. Where none has frames, one with
// other pictures: it can say what is wrong with them.
std::optional<fs::path> depth_folder(const fs::path& folder, std::vector<std::string> names) {
  std::erase_if(names, std::not_fn(is_named_depth));
  for (const Content wanted : {Content::frames, Content::other_pictures}) {
    std::vector<std::string> those;
    std::ranges::copy_if(names, std::back_inserter(those),
                         [&](const std::string& name) { return content_of(folder / name) == wanted; });
    const auto exact = std::ranges::find(those, "depth", lower_case);
    if (exact != those.end() || those.size() == 1) {
      return folder / (exact != those.end() ? *exact : those.front());
    }
    if (!those.empty()) {
      break;
    }
  }
  return {};
}

// The first three names of a list.
std::string in_words(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  const std::size_t shown = std::min(names.size(), kMost);
  const std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return names.size() > shown ? fmt::format("{} (and {} more)", text, names.size() - shown) : text;
}

// Why no frames were found, and where there are some.
[[noreturn]] void refuse(const fs::path& place, const Candidates& found, std::vector<std::string> folders) {
  const std::string others = other_pictures(found);
  std::string problem = others.empty() ? "holds no depth pictures (.png) and no organized clouds (.pcd)"
                                       : "holds no depth pictures (grey, 16 bits): only " + others;
  if (found.colours > 0 && found.few_bits == 0) {
    problem = fmt::format("holds no depth pictures: each of its {} .png files is a picture in colours", found.colours);
  }
  std::erase_if(folders, [&](const std::string& name) { return content_of(place / name) != Content::frames; });
  if (!folders.empty()) {
    problem += fmt::format("; its sub-folder{} {} {}", folders.size() == 1 ? "" : "s", in_words(folders),
                           folders.size() == 1 ? "does" : "do");
  }
  throw InputError(place.string(), problem);
}

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

// TUM's recordings have a list for each camera with a title, or one of what belongs together.
bool is_of_tum(const fs::path& folder) {
  constexpr std::string_view kTitle = "# depth maps";
  const auto has = [&](const char* name) { return is_there(folder / name); };
  return (has("depth.txt") && (has("rgb.txt") || has("groundtruth.txt") || has("accelerometer.txt"))) ||
         has("associations.txt") || has("association.txt") || has("associate.txt") ||
         (has("depth.txt") && read_file(folder / "depth.txt", kTitle.size()) == kTitle);
}

// Of the folder's files with the word in their names the calibration for depths: the one that says so, or the only one.
std::optional<fs::path> calibration_in(const fs::path& folder, std::string_view word) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return {};
  }
  std::vector<std::string> names;
  for_each_entry(folder, [&](const fs::directory_entry& entry) {
    const std::string name = lower_case(entry.path().filename().string());
    const std::string extension = lower_extension(entry.path());
    constexpr std::array<std::string_view, 4> kExtensions = {".txt", ".json", ".yaml", ".yml"};
    const bool is_other = name.find("extrinsic") != std::string::npos || name.find("color") != std::string::npos ||
                          name.find("rgb") != std::string::npos;
    if (std::ranges::find(kExtensions, extension) != kExtensions.end() && !is_other &&
        name.find(word) != std::string::npos && is_there(entry.path())) {
      names.push_back(entry.path().filename().string());
    }
  });
  std::ranges::sort(names, natural_less);
  const auto of_depth = std::ranges::find_if(
      names, [](const std::string& name) { return lower_case(name).find("depth") != std::string::npos; });
  if (of_depth != names.end()) {
    return folder / *of_depth;
  }
  return names.size() == 1 ? std::optional(folder / names.front()) : std::nullopt;
}

// The calibration that lies in the folder, under our name or one of other programs'.
std::optional<fs::path> calibration_with(const fs::path& folder) {
  if (fs::exists(status_of(folder / kOwnCalibration))) {
    return folder / kOwnCalibration;
  }
  for (const char* name : {"camera.json", "scene_camera.json", "camera_info.yaml", "camera_info.yml",
                           "depth_camera_info.yaml", "depth_camera_info.yml", "camera_primesense.json"}) {
    if (is_there(folder / name)) {
      return folder / name;
    }
  }
  for (const auto& [place, word] :
       {std::pair{folder, "intrinsic"}, {folder / "intrinsic", ""}, {folder / "intrinsics", ""}}) {
    if (const std::optional<fs::path> file = calibration_in(place, word)) {
      return file;
    }
  }
  return {};
}

// What lies with the frames, or beside their folder where that is the part of a recording that has the depths.
void find_calibration(const fs::path& folder, RecordingFiles& files) {
  std::vector<fs::path> places = {folder};
  std::error_code error;
  const fs::path whole = (fs::current_path(error) / folder).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();
  if (is_named_depth(named)) {
    places.push_back((folder / "..").lexically_normal());
  }
  for (const fs::path& place : places) {
    files.is_of_tum = files.is_of_tum || is_of_tum(place);
    files.calibration = files.calibration ? files.calibration : calibration_with(place);
  }
}

void find_frames(const fs::path& place, RecordingFiles& files) {
  files.folder = place;
  if (fs::exists(status_of(place / "depth.txt"))) {
    files.frames = listed_files(place / "depth.txt");
    return;
  }
  Candidates found = candidates_in(place);
  if (!found.any()) {
    std::vector<std::string> folders = folders_in(place);
    const std::optional<fs::path> of_depth = depth_folder(place, folders);
    if (!of_depth) {
      refuse(place, found, std::move(folders));
    }
    files.notes.push_back("its depth pictures are those in " + of_depth->string());
    find_frames(*of_depth, files);  // which has some
    return;
  }
  if (const std::string others = other_pictures(found); !others.empty()) {
    files.notes.push_back("passes over " + others);
  }
  files.frames = frames_of(std::move(found));
}

}  // namespace

RecordingFiles find_recording(const fs::path& place) {
  const fs::file_status status = status_of(place);
  if (!fs::exists(status)) {
    throw InputError(place.string(), "no such file or folder");
  }
  RecordingFiles files;
  if (fs::is_directory(status)) {
    find_frames(place, files);
  } else {
    files.folder = place.parent_path();
    files.frames = {{place.filename().string(), 0.0}};
    files.is_one_file = true;
  }
  if (files.frames.empty()) {
    refuse(place, {}, {});
  }
  find_calibration(files.folder, files);
  return files;
}

}  // namespace spincat
