#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_list.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/files/file.h"
#include "spincat/io/organized_cloud.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;

DepthImage picture_of(float depth) {
  DepthImage image(4, 3);
  std::ranges::fill(image.depth, depth);
  return image;
}

void write_picture(const std::filesystem::path& file, float depth) {
  write_file_atomically(file, encode_depth_png(picture_of(depth), 1000.0));
}

// Without it pictures are expected to be a Kinect's, 640 x 480.
void write_calibration(const std::filesystem::path& folder) {
  write_file_atomically(folder / "camera.txt", calibration_text({}));
}

std::vector<float> depths_of(FrameSource& source) {
  std::vector<float> depths;
  while (const std::optional<Frame> frame = source.next()) {
    depths.push_back(frame->image.at(1, 1));
  }
  return depths;
}

TEST(Recording, ComesInTheOrderInWhichPeopleCount) {
  const TempDir dir;
  write_calibration(dir.path());
  write_picture(dir.path() / "frame10.png", 1.0F);
  write_picture(dir.path() / "frame9.png", 0.9F);
  write_picture(dir.path() / "frame0100.png", 2.0F);
  write_file_atomically(dir.path() / "notes.txt", "not a frame");
  EXPECT_EQ(depths_of(*open_recording(dir.path(), {})), (std::vector<float>{0.9F, 1.0F, 2.0F}));
}

TEST(Recording, TakesOrderAndTimesFromTumsList) {
  const TempDir dir;
  write_calibration(dir.path());
  std::filesystem::create_directory(dir.path() / "depth");
  write_picture(dir.path() / "depth/a.png", 1.0F);
  write_picture(dir.path() / "depth/b.png", 2.0F);
  write_file_atomically(dir.path() / "depth.txt", "# timestamp filename\n10.5 depth/b.png\n10.75 depth/a.png\n");
  const auto source = open_recording(dir.path(), {});
  const std::optional<Frame> first = source->next();
  EXPECT_EQ(first->name, "b.png");
  EXPECT_EQ(first->time, 10.5);
  EXPECT_EQ(source->next()->time, 10.75);
  EXPECT_FALSE(source->next());
}

TEST(Recording, TakesNamesAsTheListGivesThem) {
  const FrameList frames = parse_depth_list("# time file\r\n\n 1e1\ta#1.png and more\r\n-0.5 /b.png");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].file, "a#1.png");
  EXPECT_EQ(frames[0].time, 10.0);
  EXPECT_EQ(frames[1].file, "/b.png");
  EXPECT_EQ(frames[1].time, -0.5);
}

TEST(Recording, RefusesListsThatNameNoTimeOrNoFile) {
  EXPECT_EQ(input_error([] { parse_depth_list("1 a.png\n2\n"); }), "line 2: expected a file behind the time");
  EXPECT_EQ(input_error([] { parse_depth_list("\nsoon a.png\n"); }), "line 2: expected a time, found 'soon'");
  EXPECT_NE(input_error([] { parse_depth_list("1e999 a.png\n"); }), "no error");
  EXPECT_NE(input_error([] { parse_depth_list("nan a.png\n"); }), "no error");
}

TEST(Recording, NamesTheListThatItRefuses) {
  const TempDir dir;
  write_file_atomically(dir.path() / "depth.txt", "1 a.png\nnext b.png\n");
  const std::string error = input_error([&] { open_recording(dir.path(), {}); });
  EXPECT_NE(error.find("depth.txt: line 2"), std::string::npos) << error;
}

TEST(Recording, LeavesALastLineOutThatWasCutOff) {
  const TempDir dir;
  write_calibration(dir.path());
  write_picture(dir.path() / "a.png", 1.0F);
  write_picture(dir.path() / "b.png", 2.0F);
  const auto frames = [&](const std::string& list) {
    write_file_atomically(dir.path() / "depth.txt", list);
    const auto source = open_recording(dir.path(), {});
    int count = 0;
    while (source->next()) {
      ++count;
    }
    return count;
  };
  const std::string whole = "# time file\n10.5 a.png\n10.75 b.png";
  const std::size_t first = whole.find("10.75");
  for (std::size_t size = first; size < whole.size(); ++size) {
    EXPECT_EQ(frames(whole.substr(0, size)), 1) << size;
  }
  EXPECT_EQ(frames(whole), 2);  // many a list has no last line end
  EXPECT_EQ(frames(whole + "\n"), 2);
  EXPECT_EQ(frames(whole + "\r"), 2);
  EXPECT_EQ(frames(whole + "\n# the end"), 2);
  // A whole line is what somebody meant to say.
  EXPECT_NE(input_error([&] { frames("10.5 a.png\n10.75 c.png\n"); }).find("c.png: no such file"), std::string::npos);
  EXPECT_NE(input_error([&] { frames("10.5 a.png\n10.75\n"); }).find("depth.txt: line 2"), std::string::npos);
  EXPECT_NE(input_error([&] { frames("10.75"); }).find("depth.txt: line 1"), std::string::npos);
}

TEST(Recording, GoesOnAfterAFrameThatCannotBeRead) {
  const TempDir dir;
  write_calibration(dir.path());
  write_picture(dir.path() / "1.png", 1.0F);
  const std::string whole = encode_depth_png(picture_of(1.0F), 1000.0);
  write_file_atomically(dir.path() / "2.png", whole.substr(0, whole.size() / 2));
  write_picture(dir.path() / "3.png", 3.0F);
  const auto source = open_recording(dir.path(), {});
  EXPECT_TRUE(source->next());
  EXPECT_NE(input_error([&] { source->next(); }).find("2.png: is no depth picture"), std::string::npos);
  EXPECT_EQ(source->next()->image.at(0, 0), 3.0F);
}

TEST(Recording, ReadsNoDevicesAndNoPipes) {
  const TempDir dir;
  write_calibration(dir.path());
  write_picture(dir.path() / "1.png", 1.0F);
  ASSERT_EQ(mkfifo((dir / "2.png").c_str(), 0600), 0);
  std::filesystem::create_symlink("1.png", dir / "3.png");
  std::filesystem::create_symlink("/dev/zero", dir / "4.png");
  std::filesystem::create_directory(dir / "5.png");
  const auto folder = open_recording(dir.path(), {});
  EXPECT_TRUE(folder->next());
  EXPECT_EQ(input_error([&] { folder->next(); }), (dir / "2.png").string() + ": is not a regular file");
  EXPECT_TRUE(folder->next());
  EXPECT_EQ(input_error([&] { folder->next(); }), (dir / "4.png").string() + ": is not a regular file");
  EXPECT_EQ(input_error([&] { folder->next(); }), (dir / "5.png").string() + ": is a folder, not a file");
  write_file_atomically(dir / "depth.txt", "1 /dev/zero\n2 1.png\n");
  const auto list = open_recording(dir.path(), {});
  EXPECT_EQ(input_error([&] { list->next(); }), "/dev/zero: is not a regular file");
  EXPECT_TRUE(list->next());
}

TEST(Recording, ReadsNoListAndNoCalibrationFromAPipe) {
  for (const char* name : {"depth.txt", "camera.txt"}) {
    const TempDir dir;
    write_picture(dir.path() / "1.png", 1.0F);
    ASSERT_EQ(mkfifo((dir / name).c_str(), 0600), 0);
    EXPECT_EQ(input_error([&] { open_recording(dir.path(), {}); }), (dir / name).string() + ": is not a regular file");
  }
}

TEST(Recording, LeavesFramesOut) {
  const TempDir dir;
  write_calibration(dir.path());
  for (const int k : {1, 2, 3}) {
    write_picture(dir.path() / (std::to_string(k) + ".png"), static_cast<float>(k));
  }
  write_file_atomically(dir.path() / "2.png", "nothing");  // what is left out need not be readable
  const auto source = open_recording(dir.path(), {});
  EXPECT_EQ(source->next()->image.at(0, 0), 1.0F);
  source->skip();
  EXPECT_EQ(source->next()->image.at(0, 0), 3.0F);
  source->skip();  // beyond the end
  EXPECT_FALSE(source->next());
}

TEST(Recording, BeginsAgainWhereItLoops) {
  const TempDir dir;
  write_calibration(dir.path());
  write_picture(dir.path() / "1.png", 1.0F);
  write_picture(dir.path() / "2.png", 2.0F);
  FrameSettings settings;
  settings.loop = true;
  const auto source = open_recording(dir.path(), settings);
  double before = -1.0;
  for (int k = 0; k < 7; ++k) {
    const std::optional<Frame> frame = source->next();
    EXPECT_EQ(frame->image.at(0, 0), k % 2 == 0 ? 1.0F : 2.0F);
    EXPECT_GT(frame->time, before);
    before = frame->time;
  }
}

TEST(Recording, IsCalibratedByItsFolderOrByAFile) {
  const TempDir dir;
  write_picture(dir.path() / "1.png", 1.0F);
  EXPECT_NE(input_error([&] {
              open_recording(dir.path(), {})->next();
            }).find("is 4 x 3 pixels large where the calibration says 640 x 480"),
            std::string::npos);
  write_file_atomically(dir.path() / "camera.txt", "fx 600\nfy 601\ncx 2\ncy 1\nunits_per_metre 500\n");
  const std::optional<Frame> frame = open_recording(dir.path(), {})->next();
  EXPECT_EQ(frame->intrinsics.fy, 601.0);
  EXPECT_EQ(frame->image.at(0, 0), 2.0F);
  FrameSettings settings;
  settings.units_per_metre = 2000.0;
  EXPECT_EQ(open_recording(dir.path(), settings)->next()->image.at(0, 0), 0.5F);
  write_file_atomically(dir.path() / "other.txt", "fx 300\nfy 300\ncx 2\ncy 1\nwidth 640\n");
  settings.calibration = dir.path() / "other.txt";
  EXPECT_NE(input_error([&] { open_recording(dir.path(), settings)->next(); }).find("640"), std::string::npos);
}

// An organized cloud of a tilted plane with holes, as PCL writes it.
std::string organized_pcd(int width, int height, const Intrinsics& k) {
  std::string text = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(width) +
                     "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
                     std::to_string(width * height) + "\nDATA ascii\n";
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double z = 1.0 + 0.01 * u;
      text += (u + v) % 5 == 0 ? "nan nan nan\n"
                               : std::to_string((u - k.cx) * z / k.fx) + " " + std::to_string((v - k.cy) * z / k.fy) +
                                     " " + std::to_string(z) + "\n";
    }
  }
  return text;
}

TEST(Recording, ReadsOrganizedCloudsWithTheirOwnCalibration) {
  const TempDir dir;
  const Intrinsics k{500.0, 510.0, 10.0, 8.0};
  write_file_atomically(dir.path() / "cloud.pcd", organized_pcd(20, 16, k));
  const std::optional<Frame> frame = open_recording(dir.path() / "cloud.pcd", {})->next();
  EXPECT_NEAR(frame->intrinsics.fx, 500.0, 0.5);
  EXPECT_NEAR(frame->intrinsics.fy, 510.0, 0.5);
  EXPECT_NEAR(frame->intrinsics.cx, 10.0, 0.01);
  EXPECT_NEAR(frame->intrinsics.cy, 8.0, 0.01);
  EXPECT_NEAR(frame->image.at(3, 1), 1.03F, 1e-5F);
  EXPECT_EQ(frame->image.at(0, 0), 0.0F);
}

TEST(OrganizedCloud, RefusesWhatIsNoPicture) {
  EXPECT_NE(input_error([] { read_organized_pcd(organized_pcd(20, 1, {})); }).find("no picture"), std::string::npos);
  const std::string whole = organized_pcd(20, 16, {});
  EXPECT_NE(input_error([&] { read_organized_pcd(whole.substr(0, whole.size() / 2)); }), "no error");
}

TEST(Recording, SaysWhatIsWrongWithThePlace) {
  const TempDir dir;
  EXPECT_NE(input_error([&] { open_recording(dir.path() / "none", {}); }).find("no such file"), std::string::npos);
  EXPECT_NE(input_error([&] { open_recording(dir.path(), {}); }).find("no depth pictures"), std::string::npos);
  const std::string loop = (dir / "loop").string();
  std::filesystem::create_symlink("loop", loop);
  EXPECT_EQ(input_error([&] { open_recording(loop, {}); }), loop + ": too many levels of symbolic links");
  const std::string name(300, 'n');
  EXPECT_EQ(input_error([&] { open_recording(name, {}); }), name + ": file name too long");
}

// As somebody who may not read it: root may read everything.
TEST(Recording, SaysThatAFolderCannotBeRead) {
  using std::filesystem::perms;
  const TempDir dir;
  std::filesystem::permissions(dir.path(), perms::owner_exec | perms::group_exec | perms::others_exec);
  const uid_t root = geteuid();
  ASSERT_TRUE(root != 0 || seteuid(65'534) == 0);
  EXPECT_EQ(input_error([&] { open_recording(dir.path(), {}); }),
            dir.path().string() + ": cannot be read: permission denied");
  EXPECT_TRUE(root != 0 || seteuid(root) == 0);
  std::filesystem::permissions(dir.path(), perms::owner_all);
}

TEST(Calibration, ReadsWhatItWrote) {
  CameraCalibration calibration;
  calibration.intrinsics = {570.5, 571.25, 320.0, 240.125};
  calibration.units_per_metre = 5000.0;
  calibration.width = 640;
  const CameraCalibration back = parse_calibration(calibration_text(calibration));
  EXPECT_EQ(back.intrinsics.fy, 571.25);
  EXPECT_EQ(back.intrinsics.cy, 240.125);
  EXPECT_EQ(back.units_per_metre, 5000.0);
  EXPECT_EQ(back.width, 640);
  EXPECT_FALSE(back.height);
}

TEST(Calibration, SaysWhatIsWrong) {
  const std::string good = "fx 525\nfy 525\ncx 319.5\n";
  EXPECT_EQ(input_error([&] { parse_calibration(good); }), "does not give cy");
  EXPECT_EQ(input_error([&] { parse_calibration(good + "cy half\n"); }),
            "line 4: expected a number behind the name, as in \"fx 525\", found 'half'");
  EXPECT_EQ(input_error([&] { parse_calibration(good + "cy 1 2\n"); }),
            "line 4: expected the end of the line, found '2'");
  EXPECT_NE(input_error([&] { parse_calibration(good + "cy 1\nfocus 3\n"); }).find("line 5: 'focus' is not known"),
            std::string::npos);
  EXPECT_NE(input_error([&] { parse_calibration("fx 0\nfy 525\ncx 1\ncy 1\n"); }).find("fx 0 is out of range"),
            std::string::npos);
  EXPECT_NE(input_error([&] { parse_calibration(good + "cy 1\nunits_per_metre 0\n"); }).find("out of range"),
            std::string::npos);
}

}  // namespace
}  // namespace spincat
