// Folders as cameras and other programs leave them.
#include <gtest/gtest.h>
#include <lodepng.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "spincat/camera/source/depth_png.h"
#include "spincat/camera/source/frame_source.h"
#include "support/expect_error.h"
#include "support/png_bytes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using Notes = std::vector<std::string>;

constexpr const char* kCamera = "fx 5\nfy 5\ncx 2\ncy 1\n";

std::string depth_picture(float depth) {
  DepthImage image(4, 3);
  std::ranges::fill(image.depth, depth);
  return encode_depth_png(image, 1000.0);
}

std::string colour_picture() {
  std::vector<unsigned char> file;
  lodepng::encode(file, std::vector<unsigned char>(36, 9), 4, 3, LCT_RGB, 8);
  return {file.begin(), file.end()};
}

std::string grey_picture() {
  return test::png_file(4, 3, 8, 0, "");
}

// The names of a recording's frames with their depths.
std::vector<std::pair<std::string, float>> frames_of(FrameSource& source) {
  std::vector<std::pair<std::string, float>> frames;
  while (const std::optional<Frame> frame = source.next()) {
    frames.emplace_back(frame->name, frame->image.at(1, 1));
  }
  return frames;
}

using Frames = std::vector<std::pair<std::string, float>>;

class RecordingFiles : public testing::Test {
 protected:
  std::string place(const std::string& name = "") const { return (name.empty() ? dir_.path() : dir_ / name).string(); }
  std::unique_ptr<FrameSource> open(const std::string& name = "") const { return open_recording(place(name), {}); }

  test::TempDir dir_;
};

TEST_F(RecordingFiles, PassesOverWhatLiesBesideDepthPictures) {
  dir_.write("camera.txt", kCamera);
  for (int k = 0; k < 11; ++k) {
    dir_.write("rec_Color_" + std::to_string(1000 + k) + ".png", colour_picture());
  }
  dir_.write("rec_Infrared_1000.png", grey_picture());
  dir_.write("rec_Depth_1001.png", depth_picture(2.0F));
  dir_.write("rec_Depth_1000.PNG", depth_picture(1.0F));
  const auto source = open();
  EXPECT_EQ(source->notes(), Notes{place() + ": passes over 11 pictures in colours, 1 picture of 8 bits or fewer"});
  EXPECT_EQ(frames_of(*source), (Frames{{"rec_Depth_1000.PNG", 1.0F}, {"rec_Depth_1001.png", 2.0F}}));
}

TEST_F(RecordingFiles, SaysNothingWhereNothingIsPassedOver) {
  dir_.write("camera.txt", kCamera);
  dir_.write("0.png", depth_picture(1.0F));
  dir_.write("0.jpg", "of the same moment");
  EXPECT_EQ(open()->notes(), Notes{});
}

// Labels and masks may be grey and of 16 bits, as depths are.
TEST_F(RecordingFiles, TakesThoseThatAreCalledDepth) {
  dir_.write("camera.txt", kCamera);
  dir_.write("000001-depth.png", depth_picture(1.0F));
  dir_.write("000001-label.png", depth_picture(2.0F));
  dir_.write("000002-Depth.png", depth_picture(3.0F));
  const auto source = open();
  EXPECT_EQ(source->notes(), Notes{place() + ": passes over 1 picture without \"depth\" in the name"});
  EXPECT_EQ(frames_of(*source), (Frames{{"000001-depth.png", 1.0F}, {"000002-Depth.png", 3.0F}}));
}

TEST_F(RecordingFiles, CountsFramesWithoutThoseItPassesOver) {
  dir_.write("camera.txt", kCamera);
  for (int k = 0; k < 6; ++k) {
    dir_.write(std::to_string(k) + ".png", k % 2 == 0 ? colour_picture() : depth_picture(1.0F));
  }
  const auto source = open();
  source->skip();
  const std::optional<Frame> second = source->next();
  EXPECT_EQ(second->name, "3.png");
  EXPECT_NEAR(second->time, 1.0 / 30.0, 1e-9);
}

TEST_F(RecordingFiles, ReportsWhatIsNoPictureAmongThem) {
  dir_.write("camera.txt", kCamera);
  dir_.write("0.png", colour_picture());
  dir_.write("1.png", "torn");
  dir_.write("2.png", depth_picture(1.0F));
  ASSERT_EQ(mkfifo((dir_ / "3.png").c_str(), 0600), 0);  // which nobody writes to
  const auto source = open();
  EXPECT_NE(input_error([&] { source->next(); }).find("1.png: is no depth picture"), std::string::npos);
  EXPECT_EQ(source->next()->name, "2.png");
  EXPECT_NE(input_error([&] { source->next(); }).find("3.png: is not a regular file"), std::string::npos);
}

TEST_F(RecordingFiles, TakesCloudsBesideColours) {
  dir_.write("0.png", colour_picture());
  dir_.write("0.pcd",
             "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\nPOINTS 4\nDATA ascii\n"
             "0 0 1\n0 0 1\n0 0 1\n0 0 1\n");
  const auto source = open();
  EXPECT_EQ(source->next()->name, "0.pcd");
  EXPECT_EQ(source->notes(), Notes{place() + ": passes over 1 picture in colours"});
}

TEST_F(RecordingFiles, RefusesFoldersWithoutDepthPictures) {
  const auto error = [&](const std::string& name) {
    const std::string all = input_error([&] { open(name); });
    return all.starts_with(place(name) + ": ") ? all.substr(place(name).size() + 2) : all;
  };
  dir_.write("rgb/0.png", colour_picture());
  dir_.write("rgb/1.png", colour_picture());
  EXPECT_EQ(error("rgb"), "holds no depth pictures: each of its 2 .png files is a picture in colours");
  dir_.write("grey/0.png", grey_picture());
  EXPECT_EQ(error("grey"), "holds no depth pictures (grey, 16 bits): only 1 picture of 8 bits or fewer");
  dir_.write("both/0.png", grey_picture());
  dir_.write("both/1.png", colour_picture());
  EXPECT_EQ(error("both"),
            "holds no depth pictures (grey, 16 bits): only 1 picture in colours, 1 picture of 8 bits or fewer");
  fs::create_directory(dir_ / "empty");
  EXPECT_EQ(error("empty"), "holds no depth pictures (.png) and no organized clouds (.pcd)");
  EXPECT_EQ(error(""), "holds no depth pictures (.png) and no organized clouds (.pcd)");
  dir_.write("seq-01/0.png", depth_picture(1.0F));
  EXPECT_EQ(error(""), "holds no depth pictures (.png) and no organized clouds (.pcd); its sub-folder seq-01 does");
  for (const int k : {10, 9, 2, 3}) {
    dir_.write("seq-" + std::to_string(k) + "/0.png", depth_picture(1.0F));
  }
  EXPECT_EQ(
      error(""),
      "holds no depth pictures (.png) and no organized clouds (.pcd); its sub-folders seq-01, seq-2, seq-3 (and 2 "
      "more) do");
}

TEST_F(RecordingFiles, APictureThatIsNamedByItselfStaysAnError) {
  dir_.write("camera.txt", kCamera);
  dir_.write("0.png", depth_picture(1.0F));
  dir_.write("colour.png", colour_picture());
  EXPECT_NE(input_error([&] { open("colour.png")->next(); }).find("colour.png: is a picture in colours"),
            std::string::npos);
  dir_.write("grey.png", grey_picture());
  EXPECT_EQ(
      input_error([&] { open("grey.png")->next(); }),
      place("grey.png") + ": has pixels of 8 bits or fewer where 16 bits were expected: grey tones, and no depths");
  dir_.write("depth.txt", "0 grey.png\n1 0.png\n");
  const auto listed = open();
  EXPECT_NE(input_error([&] { listed->next(); }).find("8 bits"), std::string::npos);
  EXPECT_EQ(listed->next()->name, "0.png");
}

TEST_F(RecordingFiles, FindsTheDepthsOfARecordingInFolders) {
  for (const char* name : {"depth", "Depth", "depth_images", "aligned_depth_to_color"}) {
    SCOPED_TRACE(name);
    const std::string root = std::string("in_") + name;
    dir_.write(root + "/" + name + "/0.png", depth_picture(1.5F));
    dir_.write(root + "/color/0.png", colour_picture());
    dir_.write(root + "/cover.png", colour_picture());
    dir_.write(root + "/camera.txt", kCamera);
    const auto source = open(root);
    EXPECT_EQ(source->notes(), Notes{place(root) + ": its depth pictures are those in " + place(root) + "/" + name});
    EXPECT_EQ(frames_of(*source), (Frames{{"0.png", 1.5F}}));
  }
}

TEST_F(RecordingFiles, ChoosesTheFolderThatIsCalledDepth) {
  dir_.write("camera.txt", kCamera);
  dir_.write("depth/0.png", depth_picture(1.0F));
  dir_.write("depth_bfx/0.png", depth_picture(2.0F));
  EXPECT_EQ(frames_of(*open()), (Frames{{"0.png", 1.0F}}));
  fs::rename(dir_ / "depth", dir_ / "depth_raw");
  EXPECT_NE(input_error([&] { open(); }).find("its sub-folders depth_bfx, depth_raw do"), std::string::npos);
  fs::remove_all(dir_ / "depth_bfx");
  fs::create_directory_symlink(".", dir_ / "depth");  // no way down without an end
  EXPECT_EQ(frames_of(*open()), (Frames{{"0.png", 1.0F}}));
}

TEST_F(RecordingFiles, SaysWhatIsWrongWithTheDepthsInAFolder) {
  dir_.write("depth/0.png", grey_picture());
  dir_.write("rgb/0.png", colour_picture());
  EXPECT_EQ(input_error([&] { open(); }),
            place("depth") + ": holds no depth pictures (grey, 16 bits): only 1 picture of 8 bits or fewer");
  dir_.write("depth_raw/0.png", depth_picture(1.0F));  // the others are for people to look at
  dir_.write("camera.txt", kCamera);
  EXPECT_EQ(frames_of(*open()), (Frames{{"0.png", 1.0F}}));
}

TEST_F(RecordingFiles, FindsTheCalibrationThatLiesWithTheFrames) {
  const struct {
    const char* file;
    const char* text;
  } kCases[] = {
      {"intrinsic/intrinsic_depth.txt", "5 0 2 0\n0 5 1 0\n0 0 1 0\n0 0 0 1\n"},  // ScanNet
      {"intrinsic.json", R"({"width": 4, "height": 3, "intrinsic_matrix": [5, 0, 0, 0, 5, 0, 2, 1, 1]})"},
      {"camera_intrinsic.json", R"({"width": 4, "height": 3, "intrinsic_matrix": [5, 0, 0, 0, 5, 0, 2, 1, 1]})"},
      {"intrinsics.txt", "5 0 2 0 5 1 0 0 1"},             // SUN3D
      {"camera-intrinsics.txt", "5 0 2\n0 5 1\n0 0 1\n"},  // 3DMatch
      {"intrinsics/only.json", R"({"fx": 5, "fy": 5, "ppx": 2, "ppy": 1})"},
      {"Depth_Intrinsics.txt", "5 5 2 1"},
      {"camera_info.yaml", "K: [5, 0, 2, 0, 5, 1, 0, 0, 1]\n"},
  };
  for (const auto& each : kCases) {
    SCOPED_TRACE(each.file);
    test::TempDir dir;
    dir.write("depth/0.png", depth_picture(1.0F));
    dir.write("color/0.png", colour_picture());
    dir.write("intrinsic/intrinsic_color.txt", "9 0 2 0\n0 9 1 0\n0 0 1 0\n0 0 0 1\n");
    dir.write("intrinsics_color.json", "{torn");
    dir.write("intrinsic/extrinsic_depth.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    if (std::string(each.file).find("intrinsic_depth") == std::string::npos) {
      fs::remove_all(dir / "intrinsic");
    }
    const std::string file = dir.write(each.file, each.text).string();
    for (const fs::path& place : {dir.path(), dir / "depth", dir / "depth/", dir / "depth/0.png"}) {
      const auto source = open_recording(place, {});
      EXPECT_EQ(source->notes().back(), place.string() + ": its camera is that of " + file);
      EXPECT_EQ(source->next()->intrinsics.fx, 5.0);
    }
  }
}

TEST_F(RecordingFiles, AnOwnCalibrationOrANamedOneComesFirst) {
  dir_.write("0.png", depth_picture(1.0F));
  dir_.write("intrinsic.json", "{torn");
  EXPECT_NE(input_error([&] { open(); }).find("intrinsic.json: line 1: '{' is not closed"), std::string::npos);
  const std::string camera = dir_.write("camera.txt", kCamera).string();
  EXPECT_EQ(open()->next()->intrinsics.fx, 5.0);
  FrameSettings settings;
  settings.calibration = dir_.write("other.yaml", "fx: 6\nfy: 6\ncx: 2\ncy: 1\nwidth: 5\n");
  EXPECT_NE(input_error([&] {
              open_recording(place(), settings)->next();
            }).find("4 x 3 pixels large where the calibration says 5"),
            std::string::npos);
}

TEST_F(RecordingFiles, KnowsTumsUnits) {
  const std::string list = "# depth maps\n# timestamp filename\n1305031102.160407 depth/a.png\n";
  const auto units_of = [&](const std::string& name, const FrameSettings& settings) {
    const std::optional<Frame> frame = open_recording(place(name), settings)->next();
    return 1000.0F / frame->image.at(1, 1);  // of a picture with 1000 in it
  };
  FrameSettings camera;
  camera.calibration = dir_.write("camera.yaml", "fx: 5\nfy: 5\ncx: 2\ncy: 1\n");
  for (const std::string other : {"rgb.txt", "groundtruth.txt", "accelerometer.txt", "associations.txt"}) {
    SCOPED_TRACE(other);
    const std::string root = "tum_" + other;
    dir_.write(root + "/depth/a.png", depth_picture(1.0F));
    dir_.write(root + "/" + other, "");
    if (other != "associations.txt") {
      dir_.write(root + "/depth.txt", list);
    }
    for (const std::string part : {"", "/depth", "/depth/a.png"}) {
      EXPECT_NEAR(units_of(root + part, camera), 5000.0F, 1.0F) << part;
      EXPECT_NE(open_recording(place(root + part), camera)
                    ->notes()
                    .back()
                    .find("5000 units a metre (--units N says otherwise)"),
                std::string::npos);
    }
    FrameSettings told = camera;
    told.units_per_metre = 2000.0;
    EXPECT_NEAR(units_of(root, told), 2000.0F, 1.0F);
    for (const std::string& note : open_recording(place(root), told)->notes()) {
      EXPECT_EQ(note.find("--units"), std::string::npos);
    }
    dir_.write(root + "/camera.txt", std::string(kCamera) + "units_per_metre 1000\n");
    EXPECT_NEAR(units_of(root, {}), 1000.0F, 1.0F);
  }
  // A list alone is TUM's by its title, or else nobody's in particular.
  dir_.write("titled/depth.txt", list);
  dir_.write("titled/depth/a.png", depth_picture(1.0F));
  EXPECT_NEAR(units_of("titled", camera), 5000.0F, 1.0F);
  dir_.write("own/depth.txt", "0 a.png\n");
  dir_.write("own/a.png", depth_picture(1.0F));
  EXPECT_NEAR(units_of("own", camera), 1000.0F, 1.0F);
}

}  // namespace
}  // namespace spincat
