// The command `spin`: the images, the points they are of, and points and normals of the user's own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "spincat/io/npy.h"
#include "support/shell.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// The numbers of a .npy file, whose type is T.
template <class T>
std::vector<T> npy_values(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t begin = 10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  std::vector<T> values((bytes.size() - begin) / sizeof(T));
  std::memcpy(values.data(), bytes.data() + begin, values.size() * sizeof(T));
  return values;
}

class SpinCommand : public testing::Test {
 protected:
  // In a folder of its own; what it prints, errors too.
  test::ShellResult run(const std::string& arguments) {
    return test::run_in_shell(
        fmt::format("cd '{}' && '{}' spin {} 2>&1", dir_.path().string(), SPINCAT_COMMAND, arguments));
  }

  void expect_refused(const std::string& arguments, const std::string& line) {
    const test::ShellResult result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.out, "spincat: " + line + "\n") << arguments;
    EXPECT_FALSE(fs::exists(dir_ / "x.npy")) << arguments;
  }

  void write_npy(const std::string& name, const std::vector<float>& values, std::vector<std::size_t> shape) {
    dir_.write(name, npy_header(shape) +
                         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)));
  }
  void write_npy(const std::string& name, const std::vector<std::int64_t>& values) {
    dir_.write(name,
               npy_header(std::array{values.size()}, "<i8") +
                   std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::int64_t)));
  }

  std::vector<float> floats(const std::string& name) { return npy_values<float>(dir_ / name); }

  test::TempDir dir_;
};

// A grid of 10 x 10 points, 1 apart, with what a scan holds besides: "nothing measured" in rows 1 and 2, a point twice,
// one far away.
std::string grid_with_strays() {
  std::string text = "0 0 5\nnan nan nan\n0 1 5\n0 1 5\n";
  for (int i = 2; i < 100; ++i) {
    text += fmt::format("{} {} 5\n", i / 10, i % 10);
    text += i == 50 ? "500 500 500\n" : "";
  }
  return text;
}

TEST_F(SpinCommand, WritesAnImageAtEveryPoint) {
  // Two points, 1 apart along x, normals along z: each sees itself at alpha 0 and the other at alpha 1, both at beta 0.
  dir_.write("pair.xyz", "10 0 0 0 0 1\n11 0 0 0 0 1\n");
  const auto result = run("pair.xyz -o pair.npy --points-output points.npy --image-width 4 --bin-size 0.5abs");
  ASSERT_EQ(result.code, 0) << result.out;
  EXPECT_EQ(result.out, "wrote pair.npy: 2 images of 4 x 4 from 2 surface points\n");
  const std::vector<float> images = floats("pair.npy");
  ASSERT_EQ(images.size(), 32U);
  for (std::size_t bin = 0; bin < 32; ++bin) {
    // beta 0 is the upper edge of row 2; alpha 0 and 1 are the left edges of columns 0 and 2
    EXPECT_NEAR(images[bin], bin % 16 == 8 || bin % 16 == 10 ? 1.0F : 0.0F, 1e-6F) << bin;
  }
  const std::vector<float> points = floats("points.npy");
  const std::vector<float> expected = {10, 0, 0, 0, 0, 1, 11, 0, 0, 0, 0, 1};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(points[i], expected[i], 1e-5F) << i;
  }
}

TEST_F(SpinCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  std::string cone = "OFF\n17 16 0\n0 0 1\n";
  for (int i = 0; i < 16; ++i) {
    cone += fmt::format("{} {} 0\n", std::cos(i * 0.3926990817), std::sin(i * 0.3926990817));
  }
  for (int i = 0; i < 16; ++i) {
    cone += fmt::format("3 0 {} {}\n", 1 + i, 1 + (i + 1) % 16);
  }
  dir_.write("cone.off", cone);
  const std::string settings = " --surface samples --points 3000 --bin-size 0.1rel";
  ASSERT_EQ(run("cone.off -o a.npy --threads 1" + settings).code, 0);
  ASSERT_EQ(run("cone.off -o b.npy --threads 3" + settings).code, 0);
  EXPECT_EQ(floats("a.npy").size(), 3000U * 400U);
  EXPECT_TRUE(floats("a.npy") == floats("b.npy"));
  const auto sheet = run("cone.off -o sheet.png --sheet 9" + settings);
  EXPECT_EQ(sheet.out, "wrote sheet.png: 9 of 3000 images of 20 x 20 from 3000 surface points\n");
}

TEST_F(SpinCommand, TellsWhichPointsOfTheFileTakePart) {
  dir_.write("scan.xyz", grid_with_strays());
  const auto result = run("scan.xyz -o a.npy --points-output p.npy --index-output i.npy --bin-size 1abs");
  ASSERT_EQ(result.code, 0) << result.out;
  EXPECT_EQ(result.out,
            "wrote a.npy: 100 images of 20 x 20 from 100 surface points; left out: 3 of the file's 103 points\n");
  std::vector<std::int64_t> expected;
  for (std::int64_t i = 0; i < 103; ++i) {
    if (i != 1 && i != 3 && i != 53) {
      expected.push_back(i);
    }
  }
  EXPECT_EQ(npy_values<std::int64_t>(dir_ / "i.npy"), expected);
  const std::vector<float> points = floats("p.npy");
  EXPECT_NEAR(points[6 * 99], 9.0F, 1e-5F);
  EXPECT_NEAR(points[6 * 99 + 1], 9.0F, 1e-5F);
}

TEST_F(SpinCommand, ChoosesRandomPointsAndTellsWhich) {
  dir_.write("scan.xyz", grid_with_strays());
  ASSERT_EQ(run("scan.xyz -o all.npy --points-output p.npy --index-output i.npy").code, 0);
  const auto result = run("scan.xyz -o some.npy --points-output sp.npy --index-output si.npy --spin-points 7");
  ASSERT_EQ(result.code, 0) << result.out;
  const auto all = npy_values<std::int64_t>(dir_ / "i.npy");
  const auto some = npy_values<std::int64_t>(dir_ / "si.npy");
  ASSERT_EQ(some.size(), 7U);
  const std::vector<float> points = floats("p.npy");
  const std::vector<float> chosen = floats("sp.npy");
  for (std::size_t k = 0; k < some.size(); ++k) {
    const auto at = std::ranges::find(all, some[k]) - all.begin();
    ASSERT_LT(at, 100);
    EXPECT_TRUE(std::equal(chosen.begin() + 6 * static_cast<std::ptrdiff_t>(k),
                           chosen.begin() + 6 * static_cast<std::ptrdiff_t>(k + 1), points.begin() + 6 * at));
  }
}

TEST_F(SpinCommand, MakesTheImagesOfKeypoints) {
  dir_.write("scan.xyz", grid_with_strays());
  ASSERT_EQ(run("scan.xyz -o all.npy --points-output p.npy --bin-size 1abs").code, 0);
  write_npy("k.npy", {102, 0, 2, 0});
  const auto result = run("scan.xyz -o k-images.npy --index-output i.npy --keypoints k.npy --bin-size 1abs");
  ASSERT_EQ(result.code, 0) << result.out;
  const std::vector<float> all = floats("all.npy");
  const std::vector<float> images = floats("k-images.npy");
  ASSERT_EQ(images.size(), 4U * 400U);
  const std::array<std::size_t, 4> rows = {99, 0, 1, 0};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_TRUE(std::equal(images.begin() + 400 * static_cast<std::ptrdiff_t>(k),
                           images.begin() + 400 * static_cast<std::ptrdiff_t>(k + 1),
                           all.begin() + 400 * static_cast<std::ptrdiff_t>(rows[k])))
        << k;
  }
  EXPECT_EQ(npy_values<std::int64_t>(dir_ / "i.npy"), (std::vector<std::int64_t>{102, 0, 2, 0}));

  // The same points as oriented points of the user's own.
  const std::vector<float> points = floats("p.npy");
  write_npy("own.npy", {points.begin() + 6 * 42, points.begin() + 6 * 44}, {2, 6});
  ASSERT_EQ(run("scan.xyz -o own-images.npy --keypoints own.npy --bin-size 1abs").code, 0);
  const std::vector<float> own = floats("own-images.npy");
  ASSERT_EQ(own.size(), 2U * 400U);
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(own[i], all[42 * 400 + i], 1e-4F) << i;
  }
}

TEST_F(SpinCommand, GivesPclsImagesByItsSearchRadius) {
  std::ifstream in(SPINCAT_TEST_DATA "/spin/pcl_golden.txt");
  std::string word;
  std::size_t count = 0;
  in >> word >> count;
  std::string positions;
  std::vector<float> normals;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 6> v{};
    for (float& value : v) {
      in >> value;
    }
    positions += fmt::format("{} {} {}\n", v[0], v[1], v[2]);
    normals.insert(normals.end(), v.begin() + 3, v.end());
  }
  dir_.write("cloud.xyz", positions);
  write_npy("normals.npy", normals, {count, 3});
  int cases = 0;
  while (in >> word) {
    int width = 0;
    double radius = 0.0;
    double degrees = 0.0;
    std::size_t images = 0;
    in >> width >> radius >> degrees >> images;
    std::vector<std::int64_t> rows(images);
    for (std::size_t k = 0; k < images; ++k) {
      rows[k] = static_cast<std::int64_t>(k);
    }
    write_npy("k.npy", rows);
    const auto result =
        run(fmt::format("cloud.xyz -o a.npy --normals normals.npy --keypoints k.npy --convention pcl "
                        "--image-width {} --radius {} --support-angle {}",
                        width, radius, degrees));
    ASSERT_EQ(result.code, 0) << result.out;
    for (const float value : floats("a.npy")) {
      float expected = 0.0F;
      in >> expected;
      ASSERT_NEAR(value, expected, 1e-6F);
    }
    ++cases;
  }
  EXPECT_EQ(cases, 4);
}

TEST_F(SpinCommand, LeavesOutPointsWithoutANormal) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  dir_.write("four.xyz", "0 0 0\nnan 0 0\n1 0 0\n0 1 0\n");
  write_npy("file.npy", {0, 0, 2, 1, 1, 1, 0, 0, 1, kNaN, 0, 1}, {4, 3});  // one for each row
  const auto result =
      run("four.xyz -o a.npy --normals file.npy --index-output i.npy --points-output p.npy --radius 2 --json");
  ASSERT_EQ(result.code, 0) << result.out;
  EXPECT_EQ(npy_values<std::int64_t>(dir_ / "i.npy"), (std::vector<std::int64_t>{0, 2}));
  EXPECT_NEAR(floats("p.npy")[5], 1.0F, 1e-6F);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("images"), 2);
  EXPECT_EQ(json.at("left_out"), 2);
  EXPECT_NEAR(json.at("bin_size").get<double>(), 0.1, 1e-12);
  write_npy("finite.npy", {0, 0, 1, 0, 0, 1, 0, 0, 1}, {3, 3});  // one for each point
  EXPECT_EQ(run("four.xyz -o a.npy --normals finite.npy --radius 2").out,
            "wrote a.npy: 3 images of 20 x 20 from 3 surface points; left out: 1 of the file's 4 points\n");
}

TEST_F(SpinCommand, RefusesArraysThatDoNotFit) {
  dir_.write("scan.xyz", grid_with_strays());
  write_npy("two.npy", {1, 2, 3, 4}, {2, 2});
  write_npy("none.npy", std::vector<float>{}, {0, 6});
  write_npy("half.npy", {0, 1.5F}, {2});
  write_npy("far.npy", {0, 103});
  write_npy("stray.npy", {0, 53});
  write_npy("zero.npy", {1, 2, 3, 0, 0, 0}, {1, 6});
  write_npy("good.npy", {0, 2});
  dir_.write("text.npy", "1 2 3");
  const std::string scan = "scan.xyz -o x.npy ";
  expect_refused(scan + "--keypoints two.npy",
                 "two.npy: holds an array of 2 x 2; expected indices, or points and normals: K x 6");
  expect_refused(scan + "--keypoints none.npy", "none.npy: holds no keypoint");
  expect_refused(scan + "--keypoints half.npy", "half.npy: row 1: 1.5 is no index of 103 points");
  expect_refused(scan + "--keypoints far.npy", "far.npy: row 1: 103 is no index of 103 points");
  expect_refused(
      scan + "--keypoints stray.npy",
      "stray.npy: row 1: point 53 has no image: it is not finite, repeats another, stands alone or is part of "
      "no face");
  expect_refused(scan + "--keypoints zero.npy",
                 "zero.npy: row 0: expected a point and a normal, found 1 2 3 and 0 0 0");
  expect_refused(scan + "--keypoints text.npy", "text.npy: is no NumPy array: it does not begin with its mark");
  expect_refused(scan + "--keypoints missing.npy", "missing.npy: no such file");
  expect_refused(scan + "--normals two.npy",
                 "two.npy: holds an array of 2 x 2; expected a normal for each of 103 points: 103 x 3");
  expect_refused(scan + "--keypoints good.npy --surface external",
                 "good.npy: holds indices, which need --surface vertices: other surfaces are of drawn points");
  expect_refused(scan + "--index-output i.npy --surface external",
                 "--index-output: the spin points are no points of the file: they are drawn, or your own");
  expect_refused(scan + "--radius 2 --bin-size 1",
                 "--radius: says the size of a bin, as --bin-size does; give one of them");
  expect_refused(scan + "--keypoints good.npy --spin-points 5",
                 "--keypoints: says which points the images are of, as --spin-points does; give one of them");
  expect_refused(scan + "--index-output ./x.npy", "./x.npy: --output and --index-output name the same file");
  expect_refused(scan + "--index-output i.txt", "i.txt: expected a name that ends in .npy");
}

}  // namespace
}  // namespace spincat
