#include "fuzz/readers.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <variant>

#include "io/zip_bytes.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_list.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/classify/model.h"
#include "spincat/dataset/category_map.h"
#include "spincat/dataset/dataset.h"
#include "spincat/error.h"
#include "spincat/evaluate/sweep_journal.h"
#include "spincat/files/magic.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/organized_cloud.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/journal.h"
#include "spincat/parallel/packing.h"
#include "spincat/settings/setting_table.h"
#include "spincat/settings/settings_json.h"
#include "support/png_bytes.h"

namespace spincat::io {
#define FORMAT(name) ObjectFormat name##_format();
#include "spincat/io/formats/formats.inc"
#undef FORMAT
}  // namespace spincat::io

namespace spincat::test {
namespace {

namespace fs = std::filesystem;

// In memory where the system has a place for such files.
fs::path folder_for_files() {
  return fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
}

// A file with the given bytes.
class ShortFile {
 public:
  ShortFile(std::string_view bytes, std::string_view extension) {
    static const fs::path kFolder = folder_for_files();
    path_ = kFolder / ("spincat-fuzz-" + std::to_string(getpid()) + std::string(extension));
    const int descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    close(descriptor);
    if (written != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("cannot write " + path_.string());
    }
  }
  ~ShortFile() { unlink(path_.c_str()); }
  ShortFile(const ShortFile&) = delete;
  ShortFile& operator=(const ShortFile&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The files that a glTF file may name: two names of one file, an empty one, no regular one.
class FolderBeside {
 public:
  FolderBeside() : path_(folder_for_files() / ("spincat-fuzz-" + std::to_string(getpid()) + "-beside")) {
    fs::create_directories(path_);
    std::string bytes;
    constexpr std::size_t kBytes = 4'096;
    for (std::uint8_t i = 0; bytes.size() < kBytes; ++i) {
      const float value = i;
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
    std::ofstream(path_ / "a.bin", std::ios::binary) << bytes;
    std::ofstream(path_ / "none.bin", std::ios::binary);
    std::error_code ignored;
    fs::create_symlink("a.bin", path_ / "b.bin", ignored);
    fs::create_directory(path_ / "folder.bin", ignored);
  }
  ~FolderBeside() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  FolderBeside(const FolderBeside&) = delete;
  FolderBeside& operator=(const FolderBeside&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

using Refusals = std::vector<std::string>;

// Keeps what a reader says when it refuses its input, and sees to it that this is a line of text.
template <class Read>
void attempt(Read read, Refusals& refusals) {
  try {
    read();
  } catch (const InputError& error) {
    constexpr std::size_t kLongest = 1'200;
    const std::string line = error.what();
    if (error.problem().empty() || line.size() > kLongest ||
        std::ranges::any_of(line, [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; })) {
      throw std::logic_error("an error that is no line of text: " + line);
    }
    refusals.push_back(line);
  }
}

std::string with_checksum(std::string bytes) {
  const auto checksum =
      static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  return bytes.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
}

void check(bool holds, const char* promise) {
  if (!holds) {
    throw std::logic_error(std::string("an object breaks a promise: ") + promise);
  }
}

bool all_finite(const std::vector<Vec3>& points) {
  return std::ranges::all_of(points, [](const Vec3& point) { return point.allFinite(); });
}

void check_mesh(const Mesh& mesh) {
  check(!mesh.triangles.empty(), "a mesh has triangles");
  check(all_finite(mesh.vertices), "vertices are finite");
  for (const Triangle& triangle : mesh.triangles) {
    check(std::ranges::all_of(triangle, [&](std::uint32_t corner) { return corner < mesh.vertices.size(); }),
          "a corner is a vertex");
  }
}

void check_cloud(const PointCloud& cloud) {
  check(!cloud.points.empty(), "a cloud has points");
  check(all_finite(cloud.points), "points are finite");
  check(cloud.normals.empty() || cloud.normals.size() == cloud.points.size(), "all points have normals, or none");
  check(!cloud.sensor || cloud.sensor->allFinite(), "a sensor is somewhere");
}

// What spincat/geometry/object.h says of an object: all that comes after a reader relies on it. Normals may be
// anything.
void check_object(const Object& object) {
  if (const auto* mesh = std::get_if<Mesh>(&object)) {
    check_mesh(*mesh);
  } else {
    check_cloud(std::get<PointCloud>(object));
  }
}

template <io::ObjectFormat (*kFormat)()>
void read_object_file(std::string_view bytes, Refusals& refusals) {
  static const io::ObjectFormat kKept = kFormat();
  attempt([&] { check_object(kKept.read({bytes, {}}, {})); }, refusals);
}

void read_pcd(std::string_view bytes, Refusals& refusals) {
  read_object_file<io::pcd_format>(bytes, refusals);
  attempt([&] { read_organized_pcd(bytes); }, refusals);
}

void read_gltf(std::string_view bytes, Refusals& refusals) {
  static const FolderBeside kFolder;
  static const io::ObjectFormat kFormat = io::gltf_format();
  attempt([&] { check_object(kFormat.read({bytes, kFolder.path()}, {})); }, refusals);
}

// An archive, and the model of one.
void read_threemf(std::string_view bytes, Refusals& refusals) {
  read_object_file<io::threemf_format>(bytes, refusals);
  read_object_file<io::threemf_format>(zip({{"3D/3dmodel.model", std::string(bytes)}}, false), refusals);
}

// An array or an archive of arrays, and the only array of an archive.
void read_numpy(std::string_view bytes, Refusals& refusals) {
  read_object_file<io::numpy_format>(bytes, refusals);
  read_object_file<io::numpy_format>(zip({{"points.npy", std::string(bytes)}}), refusals);
}

// By whatever format the bytes look like.
void read_any(std::string_view bytes, Refusals& refusals) {
  attempt([&] { check_object(read_object(ShortFile(bytes, ".obj").path())); }, refusals);
  attempt([&] { is_object_file(ShortFile(bytes, ".txt").path()); }, refusals);
}

void read_csv(std::string_view bytes, Refusals& refusals) {
  const ShortFile file(bytes, ".csv");
  attempt([&] { read_dataset({file.path()}); }, refusals);
  attempt([&] { CategoryMap::read(file.path()); }, refusals);
}

void read_cla(std::string_view bytes, Refusals& refusals) {
  const ShortFile file(bytes, ".cla");
  const ShortFile map("class,category\nchair,seat\n1,a\n", ".csv");
  const fs::path models = file.path().parent_path();
  attempt([&] { read_dataset({file.path()}, {.models = models, .category_map = {}}); }, refusals);
  attempt([&] { read_dataset({file.path()}, {.models = models, .category_map = map.path()}); }, refusals);
}

// The layout is that of files/record_file.h.
std::string as_model(std::string_view content) {
  const std::string_view kind = "model";
  std::string bytes(kFileMagic);
  bytes += Packer().add(static_cast<std::uint32_t>(kind.size())).take();
  bytes += kind;
  bytes += Packer().add(kModelVersion).add(content).take();
  return with_checksum(bytes);
}

void read_model_file(std::string_view bytes, Refusals& refusals) {
  for (const std::string& all : {std::string(bytes), as_model(bytes)}) {
    attempt([&] { read_model(ShortFile(all, ".spincat").path()); }, refusals);
  }
}

const RunIdentity kRun = {"settings", "data"};

// Opens the journal, adds a task and opens it once more: the task must be there, and what was there before, too.
void read_and_continue_journal(std::string_view bytes) {
  const ShortFile file(bytes, ".journal");
  std::size_t tasks = 0;
  {
    Journal journal(file.path(), kRun);
    tasks = journal.size() + (journal.has(7, 7) ? 0 : 1);
    journal.add(7, 7, "result");
  }
  const Journal again(file.path(), kRun);
  if (again.size() != tasks || again.find(7, 7) != "result") {
    throw std::logic_error("the journal lost a task");
  }
}

// The head of a journal, whole, and then a task with these bytes and a right checksum.
std::string as_journal(std::string_view bytes) {
  const std::string_view magic("SPINCAT-JOURNAL\x01");
  return with_checksum(Packer().add(magic).add(kRun.settings).add(kRun.data).take()) +
         with_checksum(std::string(bytes));
}

void read_journal(std::string_view bytes, Refusals& refusals) {
  for (const std::string& all : {std::string(bytes), as_journal(bytes)}) {
    attempt([&] { read_and_continue_journal(all); }, refusals);
  }
}

void read_and_continue_sweep(std::string_view bytes) {
  const ShortFile file(bytes, ".journal");
  const nlohmann::ordered_json identity = {{"sweep", 1}, {"settings", {{"seed", 1}}}};
  const SweepPoint point{{"added"}, {}, {}, {}};
  SweepJournal(file.path(), identity).add(point);
  if (SweepJournal(file.path(), identity).find(point.values) == nullptr) {
    throw std::logic_error("the journal lost a point");
  }
}

// The same lines with right checksums.
std::string as_sweep(std::string_view bytes) {
  std::string text;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    std::array<char, 16> checksum{};
    std::snprintf(checksum.data(), checksum.size(), " %08lx",
                  crc32_z(0, reinterpret_cast<const Bytef*>(line.data()), line.size()));
    text.append(line).append(checksum.data()).append("\n");
    begin = end + 1;
  }
  return text;
}

void read_sweep(std::string_view bytes, Refusals& refusals) {
  for (const std::string& all : {std::string(bytes), as_sweep(bytes)}) {
    attempt([&] { read_and_continue_sweep(all); }, refusals);
  }
}

// Settings as a model has them, or one of them as a user names it: NAME=VALUE.
void read_settings_text(std::string_view bytes) {
  if (const auto json = nlohmann::json::parse(bytes, nullptr, false); !json.is_discarded()) {
    settings_from_json(json);
    return;
  }
  const std::size_t equals = bytes.find('=');
  const std::string_view text = equals == std::string_view::npos ? std::string_view() : bytes.substr(equals + 1);
  SettingChoices(preset("default"), {{std::string(bytes.substr(0, equals)), std::string(text), ""}}).settings();
}

void read_settings(std::string_view bytes, Refusals& refusals) {
  attempt([&] { read_settings_text(bytes); }, refusals);
}

// A picture with right checksums: its width, height, bits and way of interlacing, a byte each, and then its packed
// pixels.
std::string as_png(std::string_view bytes) {
  constexpr std::size_t kHead = 4;
  std::string head(bytes.substr(0, kHead));
  head.resize(kHead);
  const auto side = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(head[i])}; };
  return png_file(side(0), side(1), head[2], head[3], png_chunk("IDAT", bytes.substr(std::min(kHead, bytes.size()))));
}

void read_png(std::string_view bytes, Refusals& refusals) {
  for (const std::string& all : {std::string(bytes), as_png(bytes)}) {
    attempt([&] { decode_depth_png(all, 1000.0); }, refusals);
  }
}

void read_frames(std::string_view bytes, Refusals& refusals) {
  attempt([&] { parse_depth_list(bytes); }, refusals);
}

void read_camera(std::string_view bytes, Refusals& refusals) {
  attempt([&] { parse_calibration(bytes); }, refusals);
}

using Reader = std::pair<std::string_view, void (*)(std::string_view, Refusals&)>;

constexpr std::array kReaders = {Reader{"off", read_object_file<io::off_format>},
                                 Reader{"obj", read_object_file<io::obj_format>},
                                 Reader{"ply", read_object_file<io::ply_format>},
                                 Reader{"stl", read_object_file<io::stl_format>},
                                 Reader{"pcd", read_pcd},
                                 Reader{"xyz", read_object_file<io::xyz_format>},
                                 Reader{"gltf", read_gltf},
                                 Reader{"threemf", read_threemf},
                                 Reader{"numpy", read_numpy},
                                 Reader{"las", read_object_file<io::las_format>},
                                 Reader{"kitti", read_object_file<io::kitti_format>},
                                 Reader{"any", read_any},
                                 Reader{"csv", read_csv},
                                 Reader{"cla", read_cla},
                                 Reader{"model", read_model_file},
                                 Reader{"journal", read_journal},
                                 Reader{"sweep", read_sweep},
                                 Reader{"settings", read_settings},
                                 Reader{"png", read_png},
                                 Reader{"frames", read_frames},
                                 Reader{"camera", read_camera}};

}  // namespace

const std::vector<std::string>& reader_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const auto& [name, read] : kReaders) {
      names.emplace_back(name);
    }
    return names;
  }();
  return kNames;
}

std::vector<std::string> read_as(std::string_view reader, std::string_view bytes) {
  for (const auto& [name, read] : kReaders) {
    if (name == reader) {
      Refusals refusals;
      read(bytes, refusals);
      return refusals;
    }
  }
  throw std::invalid_argument("no reader is called " + std::string(reader));
}

}  // namespace spincat::test
