// Calibrations as people have them: of Open3D, RealSense, ROS, OpenCV and others.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "spincat/camera/source/calibration.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;

// All of them are of one camera, so that a number in the wrong place is seen.
void expect_camera(const std::string& text) {
  SCOPED_TRACE(text);
  CameraCalibration read;
  ASSERT_NO_THROW(read = parse_calibration(text));
  EXPECT_EQ(read.intrinsics.fx, 525.5);
  EXPECT_EQ(read.intrinsics.fy, 526.25);
  EXPECT_EQ(read.intrinsics.cx, 319.5);
  EXPECT_EQ(read.intrinsics.cy, 239.75);
}

TEST(CalibrationFormats, ReadsJson) {
  for (
      const char* text : {
          // Open3D: column by column
          R"({"width": 640, "height": 480, "intrinsic_matrix": [525.5, 0, 0, 0, 526.25, 0, 319.5, 239.75, 1]})",
          "{\n\t\"height\" : 480,\n\t\"intrinsic_matrix\" "
          ":\n\t[\n\t\t525.5,\n\t\t0,\n\t\t0,\n\t\t0,\n\t\t526.25,\n\t\t0,\n"
          "\t\t319.5,\n\t\t239.75,\n\t\t1\n\t],\n\t\"width\" : 640\n}\n",
          R"({"class_name": "PinholeCameraParameters", "extrinsic": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
               "intrinsic": {"height": 480, "width": 640,
                             "intrinsic_matrix": [525.5,0.0,0.0,0.0,526.25,0.0,319.5,239.75,1.0]},
               "version_major": 1})",
          // RealSense
          R"({"width": 640, "height": 480, "fx": 525.5, "fy": 526.25, "ppx": 319.5, "ppy": 239.75, "depth_scale": 0.001})",
          R"({"fx":525.5,"fy":526.25,"ppx":319.5,"ppy":239.75,"model":"Brown: {Conrady}, [0]","coeffs":[0,0,0,0,0]})",
          R"({"color": {"fx": 1, "fy": 2, "ppx": 3, "ppy": 4, "width": 1280},
               "depth": {"fx": 525.5, "fy": 526.25, "ppx": 319.5, "ppy": 239.75, "width": 640}})",
          // rows in rows
          R"({"K": [[525.5, 0, 319.5], [0, 526.25, 239.75], [0, 0, 1]]})",
          R"({"camera_matrix": {"rows": 3, "cols": 3, "data": [525.5, 0, 319.5, 0, 526.25, 239.75, 0, 0, 1]}})",
          // BOP, and nerfstudio's
          R"({"0": {"cam_K": [525.5, 0, 319.5, 0, 526.25, 239.75, 0, 0, 1], "cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1]},
               "1": {"cam_K": [525.5, 0, 319.5, 0, 526.25, 239.75, 0, 0, 1], "cam_R_w2c": [0, 1, 0, 1, 0, 0, 0, 0, 1]}})",
          R"({"fl_x": 525.5, "fl_y": 526.25, "cx": 319.5, "cy": 239.75, "w": 640, "h": 480, "frames": [{"k1": 1}]})",
      }) {
    expect_camera(text);
    expect_camera(std::string("\xEF\xBB\xBF") + text);
  }
}

TEST(CalibrationFormats, ReadsYamlAndSettings) {
  const std::string ros =
      "image_width: 640\nimage_height: 480\ncamera_name: depth\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [525.5, 0.0, 319.5, 0.0, 526.25, 239.75, 0.0, 0.0, 1.0]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0, 0, 0]\n"
      "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
      "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [500, 0, 300, 0, 0, 500, 200, 0, 0, 0, 1, 0]\n";
  for (const std::string& text : {
           ros,
           // rostopic echo, and ros2 topic echo: another message follows
           std::string(
               "header: \n  seq: 7\nheight: 480\nwidth: 640\nD: [0.0, 0.0]\nK: [525.5, 0.0, 319.5, 0.0, 526.25, "
               "239.75, "
               "0.0, 0.0, 1.0]\nR: [1.0, 0, 0, 0, 1, 0, 0, 0, 1]\nP: [500, 0, 300, 0, 0, 500, 200, 0, 0, 0, 1, 0]\n"
               "roi: \n  height: 0\n  width: 0\n---\nheight: 480\nwidth: 640\n"),
           std::string("height: 480\nwidth: 640\nd:\n- 0.0\nk:\n- 525.5\n- 0.0\n- 319.5\n- 0.0\n- 526.25\n- 239.75\n- "
                       "0.0\n- 0.0\n"
                       "- 1.0\nr:\n- 1.0\n- 0.0\nroi:\n  height: 0\n  width: 0\n---\n"),
           // only rectified pictures
           std::string("P: [525.5, 0, 319.5, 0, 0, 526.25, 239.75, 0, 0, 0, 1, 0]\n"),
           // OpenCV
           std::string(
               "%YAML:1.0\n---\ncalibration_time: \"Mon 30 Nov 2026 09:00:00\"\nimage_width: 640\ncamera_matrix: "
               "!!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 5.255e+02, 0., 319.5, 0., 526.25,\n"
               "       239.75, 0., 0., 1. ]\n"),
           // ORB-SLAM, Kalibr, flow style, a block of rows
           std::string("Camera.type: \"PinHole\"\nCamera.fx: 525.5\nCamera.fy: 526.25 # pixels\nCamera.cx: 319.5\n"
                       "Camera.cy: 239.75\nCamera.k1: 0.2\nCamera.bf: 40.0\n"),
           std::string(
               "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n"
               "  intrinsics: [525.5, 526.25, 319.5, 239.75]\n  resolution: [640, 480]\n  rostopic: /depth: x\n"),
           std::string(
               "cameras:\n  - name: depth\n    intrinsics: {fx: 525.5, fy: 526.25, cx: 319.5,\n      cy: 239.75}\n"),
           std::string("K:\n  - [525.5, 0, 319.5]\n  - [0, 526.25, 239.75]\n  - [0, 0, 1]\n"),
           std::string("K:\n- - 525.5\n  - 0\n  - 319.5\n- - 0\n  - 526.25\n  - 239.75\n- - 0\n  - 0\n  - 1\n"),
           // names and values
           std::string("fx: 525.5\r\nfy: 526.25\r\ncx: 319.5\r\ncy: 239.75\r\n"),
           std::string("# a camera\nfx=525.5\nfy = 526.25\ncx=319.5 # px\ncy=239.75"),
           std::string("[depth]\nfx=525.5\nfy=526.25\ncx=319.5\ncy=239.75\n[color]\nfx=1\nfy=1\ncx=1\ncy=1\n"),
           std::string("K = [525.5 0 319.5; 0 526.25 239.75; 0 0 1];"),
           std::string("focal_length: [525.5, 526.25]\nprincipal_point: [319.5, 239.75]\n"),
           // rs-enumerate-devices -c
           std::string(
               " Intrinsic of \"Depth\" / 640x480 / {Z16}\n  Width:      \t640\n  Height:     \t480\n  PPX:        "
               "\t319.5\n"
               "  PPY:        \t239.75\n  Fx:         \t525.5\n  Fy:         \t526.25\n  Distortion: \tBrown Conrady\n"
               "  Coeffs:     \t0  \t0  \t0  \t0  \t0  \n  FOV (deg):  \t62.7 x 49\n\n"
               " Intrinsic of \"Color\" / 1280x720 / {RGB8}\n  Width: \t1280\n  Fx: \t900\n  Fy: \t900\n  PPX: 1\n  "
               "PPY: 1\n"),
       }) {
    expect_camera(text);
  }
}

TEST(CalibrationFormats, ReadsMatricesAndFourNumbers) {
  for (const char* text : {
           "525.5 0 319.5\n0 526.25 239.75\n0 0 1\n",
           "525.5\t0.000\t319.5 \r\n0\t526.25\t239.75\r\n0\t0\t1\r\n",
           "525.5 0 319.5 0 526.25 239.75 0 0 1",
           "525.5 0 319.5 0\n0 526.25 239.75 0\n0 0 1 0\n0 0 0 1\n",
           "525.5 0 319.5 0\n0 526.25 239.75 0\n0 0 1 0\n",
           "# of the depth camera\n5.255e2, 0, 319.5\n0, 526.25, 239.75\n0, 0, 1\n",
           "[[525.5    0.   319.5 ]\n [  0.   526.25 239.75]\n [  0.     0.     1.  ]]\n",
           "525.5 0 0 0 526.25 0 319.5 239.75 1",
           "525.5 526.25 319.5 239.75",
           "\n# fx fy cx cy\n525.5, 526.25, 319.5, 239.75\n",
           "+525.5 526.25 319.5 239.75\n",
       }) {
    expect_camera(text);
  }
}

TEST(CalibrationFormats, TakesTheSizeOfTheSameCamera) {
  const auto size_of = [](const std::string& text) {
    const CameraCalibration read = parse_calibration(text);
    return std::pair(read.width.value_or(0), read.height.value_or(0));
  };
  const std::string camera = "fx: 5\nfy: 5\ncx: 3\ncy: 2\n";
  EXPECT_EQ(size_of(camera), std::pair(0, 0));
  EXPECT_EQ(size_of(camera + "width: 640\nheight: 480\n"), std::pair(640, 480));
  EXPECT_EQ(size_of(camera + "image_size: [320, 240]\n"), std::pair(320, 240));
  EXPECT_EQ(size_of(camera + "roi:\n  width: 7\n  height: 7\n"), std::pair(0, 0));
  EXPECT_EQ(size_of(R"({"width": 64, "height": 48, "depth": {"intrinsics": [5, 5, 3, 2]}})"), std::pair(64, 48));
  EXPECT_NE(input_error([&] { parse_calibration(camera + "width: 0\n"); }).find("width 0 is out of range"),
            std::string::npos);
}

// RealSense says metres a unit, Open3D and ORB-SLAM units a metre, BOP millimetres a unit.
TEST(CalibrationFormats, TakesUnits) {
  const auto units_of = [](const std::string& line) {
    return parse_calibration("fx: 5\nfy: 5\ncx: 3\ncy: 2\n" + line).units_per_metre;
  };
  EXPECT_FALSE(units_of(""));
  EXPECT_NEAR(*units_of("depth_scale: 0.001"), 1000.0, 1e-9);
  EXPECT_NEAR(*units_of("depth_scale: 0.00025"), 4000.0, 1e-9);
  EXPECT_NEAR(*units_of("depth_units: 1e-4"), 10000.0, 1e-9);
  EXPECT_EQ(units_of("depth_scale: 1000.0"), 1000.0);
  EXPECT_EQ(units_of("depth_scale: 1.0"), 1000.0);
  EXPECT_EQ(units_of("depth_scale: 0.1"), 10000.0);
  EXPECT_EQ(units_of("DepthMapFactor: 5000.0"), 5000.0);
  EXPECT_EQ(units_of("units_per_metre: 2"), 2.0);
  for (const char* line : {"depth_scale: 10", "depth_scale: 0", "depth_scale: -1"}) {
    EXPECT_NE(input_error([&] { units_of(line); }).find("depth scale"), std::string::npos) << line;
  }
}

TEST(CalibrationFormats, SaysWhatIsWrong) {
  const auto error_of = [](const std::string& text) { return input_error([&] { parse_calibration(text); }); };
  EXPECT_EQ(error_of("hello: 5\n"), "does not give fx, fy, cx and cy, nor a camera matrix");
  EXPECT_EQ(error_of("{}"), "does not give fx, fy, cx and cy, nor a camera matrix");
  EXPECT_EQ(error_of("fx: 5\nfy: 5\ncx: 5\n"), "does not give fx, fy, cx and cy, nor a camera matrix");
  EXPECT_EQ(error_of("fy: 5\nfx: wide\ncx: 5\ncy: 5\n"), "line 2: expected a number behind 'fx'");
  EXPECT_EQ(error_of("fx: 5\nfy: 5\nfx: 6\n"), "line 3: gives another 'fx' than line 1");
  EXPECT_EQ(error_of("{\"fx\": 525, \"fy\": 525,\n\"ppx\": 319.5, \"ppy\": 2"), "line 1: '{' is not closed");
  EXPECT_EQ(error_of("K: [525, 0, 319.5, 0,\n525"), "line 1: '[' is not closed");
  EXPECT_EQ(error_of("a: 1\nK: [525, 0, 319.5, 0, 525, 239.5, 0, 0]\n").substr(0, 36),
            "line 2: 'k' is no camera matrix: exp");
  EXPECT_EQ(error_of("K: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n").substr(0, 32), "line 1: 'k' is no camera matrix:");
  EXPECT_EQ(error_of("a:\n  K: [5, 5, 3, 2]\nb:\n  K: [6, 5, 3, 2]\n"),
            "gives 2 cameras that differ: leave that of the depth pictures alone in it");
  EXPECT_EQ(error_of("525 525 319.5\n").substr(0, 17), "holds 3 numbers: ");
  EXPECT_EQ(error_of("525 525 319.5 239.5 640 480\n").substr(0, 17), "holds 6 numbers: ");
  EXPECT_EQ(error_of("525 525\n319.5 half\n"), "line 2: expected a number, found 'half'");
  EXPECT_EQ(error_of("525 0 319.5 9 525 239.5 0 0 1").substr(0, 17), "holds 9 numbers: ");
  EXPECT_NE(error_of("-5 5 3 2").find("fx -5 is out of range"), std::string::npos);
  std::string deep;
  for (int k = 0; k < 40; ++k) {
    deep += "{\"a\":";
  }
  EXPECT_EQ(error_of(deep), "line 1: more than 32 groups in each other");
  EXPECT_EQ(error_of("K: " + std::string(40, '[')), "line 1: more than 32 brackets in each other");
  EXPECT_NE(error_of("a: " + std::string(1'000'000, ' ')).find("is larger than 1000000 bytes"), std::string::npos);
}

// Each of these would take hours if a character were looked at again for every other.
TEST(CalibrationFormats, TakesLargeTextsInTheirTime) {
  constexpr std::size_t kLength = 900'000;
  const std::string blanks(kLength / 2, ' ');
  std::string quotes;
  std::string lines;
  std::string groups;
  for (std::size_t k = 0; k < kLength / 10; ++k) {
    quotes += "x' ";
    lines += "a: 1\nb\n";
    groups += "a: {b: 1}\n";
  }
  for (const std::string& text : {"fx: 1\nx" + blanks + "y:", "fx: [" + blanks + quotes + "]", lines, groups,
                                  "fx: [" + lines + "]", std::string(kLength, ':'), std::string(kLength, '='),
                                  "=" + std::string(kLength, '}'), ":" + std::string(kLength, '[')}) {
    EXPECT_NE(input_error([&] { parse_calibration(text); }), "no error");
  }
}

}  // namespace
}  // namespace spincat
