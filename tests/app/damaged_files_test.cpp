// Every kind of file that the command reads, cut off and damaged: exit code 2 and one line that names the file and the
// place.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <regex>
#include <string>
#include <vector>

#include "support/temp_dir.h"

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A file that is read without complaint, the command that reads it, and a part of it that must not be left out.
struct Kind {
  std::string file;       // its name, which says the kind
  std::string arguments;  // of the command
  std::string seed;       // where it lies in tests/fuzz/seeds; empty: made by the test
  // May a file cut off at any place be whole? A list of points may; one that says how many follow may not.
  bool may_end_anywhere = false;
};

std::ostream& operator<<(std::ostream& stream, const Kind& kind) {
  return stream << kind.file;
}

class DamagedFiles : public testing::Test {
 protected:
  struct Result {
    int code = -1;
    std::string err;
  };

  Result run(const std::string& arguments) {
    const fs::path err = dir_ / ".err";
    const std::string line = fmt::format("cd '{}' && '{}' {} >/dev/null 2>'{}' </dev/null", dir_.path().string(),
                                         SPINCAT_COMMAND, arguments, err.string());
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(err)};
  }

  void make_shapes() {
    for (int i = 0; i < 4; ++i) {
      dir_.write(fmt::format("shapes/flat/{}.off", i), fmt::format("OFF 4 2\n0 0 0\n{} 0 0\n{} 2 0\n0 2 0\n"
                                                                   "3 0 1 2\n3 0 2 3\n",
                                                                   i + 2, i + 2));
      dir_.write(fmt::format("shapes/solid/{}.off", i),
                 fmt::format("OFF 4 4\n0 0 0\n{} 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", i + 1));
    }
  }

  // One line that names the file and the place, where there is anything in it at all.
  static void expect_told(const Result& result, const std::string& file) {
    static const std::regex place(
        R"(line \d+|byte \d+|\d+ bytes|(vertex|face|triangle|node|accessor|bufferView|buffer) \d+|holds neither a face nor a point)");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(result.err.rfind("spincat: " + file + ": ", 0), 0U) << result.err;
    EXPECT_TRUE(std::regex_search(result.err, place)) << result.err;
  }

  const spincat::test::TempDir dir_;
};

const std::vector<Kind> kObjectFiles = {
    {"a.off", "info a.off", "off/tetrahedron.off"},          {"binary.off", "info binary.off", "off/binary.off"},
    {"a.obj", "info a.obj", "obj/quad.obj", true},           {"ascii.ply", "info ascii.ply", "ply/ascii.ply"},
    {"little.ply", "info little.ply", "ply/little.ply"},     {"big.ply", "info big.ply", "ply/big.ply"},
    {"strips.ply", "info strips.ply", "ply/strips.ply"},     {"text.stl", "info text.stl", "stl/text.stl"},
    {"binary.stl", "info binary.stl", "stl/binary.stl"},     {"ascii.pcd", "info ascii.pcd", "pcd/ascii.pcd"},
    {"binary.pcd", "info binary.pcd", "pcd/binary.pcd"},     {"packed.pcd", "info packed.pcd", "pcd/compressed.pcd"},
    {"a.xyz", "info a.xyz", "xyz/normals.xyz", true},        {"a.pts", "info a.pts", "xyz/colours.pts", true},
    {"a.gltf", "info a.gltf", "gltf/triangle.gltf"},         {"a.glb", "info a.glb", "gltf/triangle.glb"},
    {"a.spincat", "info a.spincat", "model/linear.spincat"},
};

// Cut at every sixteenth of its length.
TEST_F(DamagedFiles, OneThatIsCutOffIsRefusedWithItsPlace) {
  for (const Kind& kind : kObjectFiles) {
    const std::string whole = contents(fs::path(SPINCAT_SOURCE_DIR) / "tests/fuzz/seeds" / kind.seed);
    dir_.write(kind.file, whole);
    ASSERT_EQ(run(kind.arguments).code, 0) << kind;
    std::vector<std::size_t> sizes;
    for (std::size_t part = 1; part < 16; ++part) {
      sizes.push_back(part * whole.size() / 16);
    }
    for (const std::size_t size : sizes) {
      SCOPED_TRACE(fmt::format("{} cut to {} of {} bytes", kind.file, size, whole.size()));
      dir_.write(kind.file, whole.substr(0, size));
      const Result result = run(kind.arguments);
      if (result.code != 0 || !kind.may_end_anywhere) {
        expect_told(result, kind.file);
      }
    }
  }
}

struct Damage {
  std::string file;
  std::string bytes;
  std::string arguments;
  std::string problem;  // how what is told begins
};

TEST_F(DamagedFiles, DamageIsToldWithItsPlace) {
  make_shapes();
  dir_.write("m.spincat", contents(fs::path(SPINCAT_SOURCE_DIR) / "tests/fuzz/seeds/model/linear.spincat"));
  const std::string small = " --copies 0 --background 4 --points 64 --spin-points 8 ";
  const std::vector<Damage> damages = {
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "info a.off", "line 4: expected a coordinate, found 'x'"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\n", "info a.obj", "line 3: vertex index 7 is out of range"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "info a.ply", "line 4: unknown type"},
      {"a.stl", "solid a\nfacet\nouter loop\nvertex 0 0\n", "info a.stl", "line 4: expected a coordinate"},
      {"a.pcd", "FIELDS x y z\nSIZE 3\n", "info a.pcd", "line 2: a field's size must be"},
      {"a.xyz", "0 0 0\n1 2\n", "info a.xyz", "line 2: expected a coordinate"},
      {"a.gltf", "{\"asset\":", "info a.gltf", "is no valid JSON at byte "},
      {"a.csv", "path,category\n\"a,b\n", "train a.csv -o x.spincat",
       "line 2: the quoted field that begins here never ends"},
      {"map.csv", "class,category\nflat,a\nflat,b\n", "train shapes --map map.csv -o x.spincat",
       "line 3: class 'flat'"},
      {"a.cla", "PSB 1\n1 1\na 0 1\nx\n", "train a.cla --models shapes -o x.spincat",
       "line 4: expected model number 1"},
      {"s.csv.journal", "{\"sweep\":1} 21dcc08b\n", "sweep shapes --vary c=1,2 -o s.csv" + small,
       "is the journal of another sweep"},
      {"t.journal", "what is this", "train shapes -o x.spincat --journal t.journal" + small,
       "is no journal of spincat"},
  };
  for (const auto& [file, bytes, arguments, problem] : damages) {
    SCOPED_TRACE(file);
    dir_.write(file, bytes);
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(result.err.rfind("spincat: " + file + ": " + problem, 0), 0U) << result.err;
    EXPECT_EQ(contents(dir_ / file), bytes);  // nothing was written over it
    EXPECT_FALSE(fs::exists(dir_ / "x.spincat"));
  }
}

// A file too large for the limits: the line names the option, and with that the file is read.
TEST_F(DamagedFiles, LimitsCanBeRaised) {
  make_shapes();
  const std::string file = "shapes/solid/0.off";
  EXPECT_EQ(run("info " + file + " --max-points 4 --max-triangles 4").code, 0);
  EXPECT_EQ(run("info " + file + " --max-points 3").err,
            "spincat: " + file + ": holds more than 3 points; --max-points raises this limit\n");
  EXPECT_EQ(run("info " + file + " --max-triangles 3").err,
            "spincat: " + file + ": holds more than 3 triangles; --max-triangles raises this limit\n");
  EXPECT_EQ(run("spin " + file + " -o a.npy --max-points 3").code, 2);
  const std::string train =
      "train shapes -o m.spincat --strict --copies 0 --background 4 --points 64 --spin-points 8 --max-points ";
  EXPECT_NE(run(train + "3").err.find("holds more than 3 points"), std::string::npos);
  EXPECT_EQ(run(train + "4").code, 0);
  EXPECT_EQ(run("classify m.spincat " + file + " --max-triangles 3").err,
            "spincat: " + file + ": holds more than 3 triangles; --max-triangles raises this limit\n");
  EXPECT_EQ(run("classify m.spincat " + file).code, 0);
  const std::string evaluate =
      "evaluate shapes --splits 2 --copies 0 --background 4 --points 64 --spin-points 8 --strict --max-points ";
  EXPECT_NE(run(evaluate + "3").err.find("--max-points raises this limit"), std::string::npos);
  EXPECT_EQ(run(evaluate + "4").code, 0);
  EXPECT_EQ(run("info " + file + " --max-points 0").code, 2);
}

// Points that are packed 88 to 1, in a file of 300 kB.
TEST_F(DamagedFiles, PackedPointsMayGrowAsFarAsTheUserLets) {
  const std::string packed = [] {
    std::string bytes("\0\0", 2);
    while (bytes.size() < 300'000) {
      bytes.append("\xE0\xFF\0", 3);
    }
    return bytes;
  }();
  const auto number = [](std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&small), sizeof(small));
  };
  const std::size_t size = 1 + (packed.size() - 2) / 3 * 264;
  dir_.write("a.pcd", fmt::format("FIELDS x y z q\nSIZE 1 1 1 1\nTYPE I I I I\nCOUNT 1 1 1 {}\nPOINTS 1\nDATA "
                                  "binary_compressed\n",
                                  size - 3) +
                          number(packed.size()) + number(size) + packed);
  const Result refused = run("info a.pcd");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--max-growth raises this limit"), std::string::npos) << refused.err;
  EXPECT_EQ(run("info a.pcd --max-growth 100").code, 0);
}

}  // namespace
