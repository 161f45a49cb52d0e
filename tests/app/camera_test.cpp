// spincat camera as a user meets it: recordings in, JSON out.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lodepng.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "app/on_terminal.h"
#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/files/file.h"
#include "spincat/io/read_object.h"
#include "support/scenes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::moved;

// A box and a cone on a table, the box a little further on in each frame.
DepthImage frame_number(int k) {
  test::Scene scene;
  scene.things = {moved(test::box(0.18, 0.18, 0.2), {-0.2 + 0.01 * k, 0.0, 0.1}),
                  moved(test::cylinder(32, 0.12, 0.0, 0.2), {0.15, 0.0, 0.0})};
  DepthImage image = scene.picture();
  Random random(static_cast<std::uint64_t>(k));
  add_sensor_noise(scene.intrinsics, 1.0, random, image);
  return image;
}

class CameraCommand : public testing::Test {
 protected:
  static constexpr int kFrames = 4;

  struct Result {
    int code = -1;
    std::string out;
    std::string err;
    std::vector<Json> lines;
    Json summary;
  };

  // A model of boxes and cones, learned once, and the frames' bytes.
  static void SetUpTestSuite() {
    folder_ = new test::TempDir;
    for (int k = 0; k < 4; ++k) {
      folder_->write(fmt::format("shapes/box/{}.off", k), test::off_text(test::box(1.0, 1.0, 1.0 + 0.1 * k)));
      folder_->write(fmt::format("shapes/cone/{}.off", k), test::off_text(test::cylinder(24, 0.5, 0.0, 1.0 + 0.1 * k)));
    }
    const Result trained = run("train shapes -o m.spincat --views 4 --up z --points 256 --spin-points 32");
    ASSERT_EQ(trained.code, 0) << trained.err;
    fs::create_directory(folder_->path() / "frames");
    for (int k = 0; k < kFrames; ++k) {
      write_file_atomically(frame_file("frames", k), encode_depth_png(frame_number(k), 1000.0));
    }
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path frame_file(const std::string& folder, int k) {
    return folder_->path() / folder / fmt::format("{}.png", k);
  }

  static std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static Result run(const std::string& arguments) {
    const fs::path out = folder_->path() / ".out";
    const fs::path err = folder_->path() / ".err";
    const int status = std::system(fmt::format("cd '{}' && '{}' {} >'{}' 2>'{}' </dev/null", folder_->path().string(),
                                               SPINCAT_COMMAND, arguments, out.string(), err.string())
                                       .c_str());
    return result_of(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(err));
  }

  static Result result_of(int code, const std::string& out, const std::string& err) {
    Result result{code, out, err, {}, {}};
    std::istringstream stream(out);
    for (std::string line; line = {}, std::getline(stream, line);) {
      const Json json = Json::parse(line, nullptr, false);
      if (json.is_discarded()) {
        continue;
      }
      if (json.contains("summary")) {
        result.summary = json.at("summary");
      } else {
        result.lines.push_back(json);
      }
    }
    return result;
  }

  // A copy of the recording that the test may spoil.
  static void copy_frames(const std::string& to) {
    fs::remove_all(folder_->path() / to);
    fs::copy(folder_->path() / "frames", folder_->path() / to);
  }

  // What is left of the lines without times.
  static std::vector<Json> without_times(std::vector<Json> lines) {
    for (Json& line : lines) {
      line.erase("milliseconds");
    }
    return lines;
  }

  // The command, running beside the test with its output in files.
  struct Running {
    pid_t pid = -1;

    Result end(int signal) const {
      if (signal != 0) {
        kill(pid, signal);
      }
      int status = 0;
      waitpid(pid, &status, 0);
      return result_of(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                       contents(folder_->path() / ".out"), contents(folder_->path() / ".err"));
    }
  };

  static Running start(const std::vector<std::string>& arguments, const std::string& out = ".out") {
    fs::remove(folder_->path() / ".out");
    const pid_t pid = fork();
    if (pid == 0) {
      std::vector<char*> argv = {const_cast<char*>("spincat")};
      for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
      }
      argv.push_back(nullptr);
      const bool ready = chdir(folder_->path().c_str()) == 0 && freopen(out.c_str(), "w", stdout) != nullptr &&
                         freopen(".err", "w", stderr) != nullptr;
      if (ready) {
        execv(SPINCAT_COMMAND, argv.data());
      }
      _exit(127);
    }
    return {pid};
  }

  // Until the output holds so many lines, or ten seconds have passed.
  static void wait_for_lines(std::ptrdiff_t count) {
    for (int k = 0; k < 500; ++k) {
      const std::string out = contents(folder_->path() / ".out");
      if (std::ranges::count(out, '\n') >= count) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  static test::TempDir* folder_;
};

test::TempDir* CameraCommand::folder_ = nullptr;

TEST_F(CameraCommand, PrintsALineForEachFrameAndASummary) {
  const Result result = run("camera m.spincat frames");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  ASSERT_EQ(result.lines.size(), 4U);
  const Json& last = result.lines[3];
  EXPECT_EQ(last.at("frame"), 3);
  EXPECT_EQ(last.at("file"), "3.png");
  EXPECT_EQ(last.at("status"), "objects");
  EXPECT_NEAR(last.at("plane").at("distance").get<double>(), 0.7, 0.01);
  EXPECT_GE(last.at("plane").at("outline").size(), 4U);
  ASSERT_EQ(last.at("objects").size(), 2U);
  std::vector<std::string> names;
  for (const Json& object : last.at("objects")) {
    names.push_back(object.at("fused").at("category"));
    EXPECT_EQ(object.at("fused").at("frames"), 4);  // followed from the first frame on
    EXPECT_EQ(object.at("status"), "named");
    EXPECT_EQ(object.at("box").size(), 4U);
    EXPECT_NEAR(object.at("centre")[2].get<double>(), object.at("distance").get<double>(), 0.3);
    EXPECT_EQ(object.at("box3d").at("axes").size(), 3U);
    EXPECT_NEAR(object.at("box3d").at("size")[2].get<double>(), object.at("height").get<double>(), 0.03);
    EXPECT_TRUE(object.at("votes").contains("cone"));
  }
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"box", "cone"}));
  for (const char* stage : {"read", "table", "segment", "name"}) {
    EXPECT_GT(last.at("milliseconds").at(stage).get<double>(), 0.0);
  }
  EXPECT_EQ(result.summary.at("frames"), 4);
  EXPECT_EQ(result.summary.at("dropped"), 0);
  EXPECT_EQ(result.summary.at("gave_up"), false);
  EXPECT_GT(result.summary.at("milliseconds").at("p99").get<double>(), 0.0);
}

TEST_F(CameraCommand, SaysTheSameWithOneAndTwoThreads) {
  const auto one = without_times(run("camera m.spincat frames --threads 1").lines);
  EXPECT_EQ(one.size(), 4U);
  EXPECT_EQ(one, without_times(run("camera m.spincat frames --threads 2").lines));
}

TEST_F(CameraCommand, RecordsWhatItCanReplay) {
  fs::remove_all(folder_->path() / "copy");
  const Result first = run("camera m.spincat frames --record copy --masks masks");
  EXPECT_EQ(first.code, 0) << first.err;
  auto replayed = without_times(run("camera m.spincat copy").lines);
  auto original = without_times(first.lines);
  ASSERT_EQ(replayed.size(), 4U);
  for (std::size_t k = 0; k < replayed.size(); ++k) {
    replayed[k].erase("file");
    original[k].erase("file");
    EXPECT_NEAR(replayed[k].at("time").get<double>(), original[k].at("time").get<double>(), 1e-6);
    replayed[k].erase("time");
    original[k].erase("time");
    EXPECT_EQ(replayed[k], original[k]);
  }
  // The masks hold each object's id on all of its pixels.
  const DepthImage mask = decode_depth_png(read_file(folder_->path() / "masks/000003.png"), 1.0);
  for (const Json& object : first.lines[3].at("objects")) {
    const auto id = object.at("id").get<float>();
    EXPECT_EQ(std::ranges::count(mask.depth, id), object.at("pixels").get<std::ptrdiff_t>());
  }
  // So do the clouds.
  const Result clouds = run("camera m.spincat frames --every 3 --clouds clouds --scene table");
  EXPECT_EQ(clouds.code, 0) << clouds.err;
  for (const Json& object : clouds.lines[1].at("objects")) {
    const std::string name = "clouds/000003-" + std::to_string(object.at("id").get<int>()) + ".ply";
    const PointCloud cloud = std::get<PointCloud>(read_object(folder_->path() / name));
    EXPECT_EQ(cloud.points.size(), object.at("pixels").get<std::size_t>());
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : cloud.points) {
      sum += p;
    }
    EXPECT_NEAR(sum.z() / static_cast<double>(cloud.points.size()), object.at("centre")[2].get<double>(), 1e-3);
  }
  EXPECT_GT(std::get<PointCloud>(read_object(folder_->path() / "clouds/000003-table.ply")).points.size(), 1000U);
  // A recording is not mixed with another.
  const Result again = run("camera m.spincat frames --record copy");
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err, "spincat: copy: is not empty\n");
}

TEST_F(CameraCommand, TakesEveryNthFrame) {
  const Result result = run("camera m.spincat frames --every 3");
  ASSERT_EQ(result.lines.size(), 2U);
  EXPECT_EQ(result.lines[1].at("frame"), 3);
}

TEST_F(CameraCommand, GoesOnAfterABrokenFrame) {
  copy_frames("broken");
  const std::string whole = read_file(frame_file("broken", 1));
  fs::resize_file(frame_file("broken", 1), whole.size() / 2);
  write_file_atomically(frame_file("broken", 2), encode_depth_png(DepthImage(320, 240), 1000.0));
  const Result result = run("camera m.spincat broken");
  EXPECT_EQ(result.code, 2);
  ASSERT_EQ(result.lines.size(), 4U);
  EXPECT_NE(result.lines[1].at("error").get<std::string>().find("1.png"), std::string::npos);
  EXPECT_NE(result.lines[2].at("error").get<std::string>().find("320 x 240"), std::string::npos);
  EXPECT_EQ(result.lines[3].at("objects").size(), 2U);
  EXPECT_EQ(result.summary.at("failed"), 2);
}

TEST_F(CameraCommand, GoesOnAfterAFrameThatThereIsNoMemoryFor) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers ask for all addresses that there are";
#endif
  copy_frames("large");
  fs::resize_file(frame_file("large", 1), std::uintmax_t{1} << 36);  // all of it a hole
  const test::OnTerminal ran =
      test::on_terminal(folder_->path(), 100, "ulimit -v 8000000;", "camera m.spincat large --json");
  const Result result = result_of(ran.code, ran.text, "");
  EXPECT_EQ(result.code, 2) << ran.text;
  ASSERT_EQ(result.lines.size(), 4U) << ran.text;
  EXPECT_EQ(result.lines[1].at("error"), "large/1.png: there is not enough memory for it");
  EXPECT_EQ(result.lines[3].at("objects").size(), 2U);
}

TEST_F(CameraCommand, SaysWhatIsWrongWithTheUnits) {
  const Result result = run("camera m.spincat frames --units 1");
  ASSERT_EQ(result.lines.size(), 4U);
  EXPECT_EQ(result.lines[0].at("status"), "wrong units");
  EXPECT_NE(result.lines[0].at("reason").get<std::string>().find("--units"), std::string::npos);
}

TEST_F(CameraCommand, SaysThatATableIsTooFarAway) {
  for (const std::string quiet : {"", " --quiet"}) {
    const Result result = run("camera m.spincat frames --units 150" + quiet);  // 0.7 m become 4.7
    EXPECT_EQ(result.code, 0);
    ASSERT_EQ(result.lines.size(), 4U);
    EXPECT_EQ(result.lines[0].at("status"), "wrong units");
    EXPECT_NE(result.lines[0].at("reason").get<std::string>().find(" m away, too far for a table: are --units right?"),
              std::string::npos)
        << result.lines[0];
    EXPECT_NEAR(result.lines[0].at("plane").at("distance").get<double>(), 4.67, 0.05);
    EXPECT_TRUE(result.lines[0].at("objects").empty());
  }
}

// As RealSense's viewer leaves them: colours, and grey tones of the infrared camera, beside the depths.
TEST_F(CameraCommand, PassesOverOtherPicturesAndSaysSoOnce) {
  copy_frames("viewer");
  std::vector<unsigned char> colours;
  ASSERT_EQ(lodepng::encode(colours, std::vector<unsigned char>(36, 9), 4, 3, LCT_RGB, 8), 0U);
  for (int k = 0; k < 12; ++k) {  // before the others in the order of names
    folder_->write(fmt::format("viewer/-Color_{}.png", k), {reinterpret_cast<char*>(colours.data()), colours.size()});
  }
  const Result result = run("camera m.spincat viewer");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "spincat: viewer: passes over 12 pictures in colours\n");
  EXPECT_EQ(result.summary.at("frames"), 4);
  EXPECT_EQ(result.lines[0].at("file"), "0.png");
  EXPECT_EQ(run("camera m.spincat viewer --quiet").err, "");
  const Result single = run("camera m.spincat viewer/-Color_1.png");
  EXPECT_EQ(single.code, 2);
  EXPECT_NE(single.lines.at(0).at("error").get<std::string>().find("picture in colours"), std::string::npos);
}

TEST_F(CameraCommand, TakesIntrinsicsOfOtherPrograms) {
  folder_->write("open3d.json",
                 R"({"width": 640, "height": 480, "intrinsic_matrix": [525, 0, 0, 0, 525, 0, 319.5, 239.5, 1]})");
  folder_->write("ros.yaml", "image_width: 640\nK: [525, 0, 319.5, 0, 525, 239.5, 0, 0, 1]\n");
  folder_->write("half.yaml", "image_width: 320\nK: [262, 0, 159.5, 0, 262, 119.5, 0, 0, 1]\n");
  const auto expected = without_times(run("camera m.spincat frames").lines);
  for (const std::string file : {"open3d.json", "ros.yaml"}) {
    const Result result = run("camera m.spincat frames --intrinsics " + file);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(without_times(result.lines), expected) << file;
  }
  const Result half = run("camera m.spincat frames --intrinsics half.yaml");
  EXPECT_EQ(half.code, 2);
  EXPECT_NE(
      half.lines.at(0).at("error").get<std::string>().find("is 640 x 480 pixels large where the calibration says 320"),
      std::string::npos);
}

TEST_F(CameraCommand, EndsWhenTheRecordingDisappears) {
  copy_frames("gone");
  const Running running = start({"camera", "m.spincat", "gone", "--loop"});
  wait_for_lines(3);
  fs::remove_all(folder_->path() / "gone");
  const Result result = running.end(0);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.summary.at("failed"), 10);
  EXPECT_EQ(result.summary.at("gave_up"), true);
  EXPECT_EQ(result.err, "spincat: ten frames in a row could not be read: those after them were not looked at\n");
  EXPECT_NE(result.lines.back().at("error").get<std::string>().find("no such file"), std::string::npos);
}

TEST_F(CameraCommand, TenBadFramesAtTheEndHideNone) {
  copy_frames("ending");
  for (int k = kFrames; k < kFrames + 10; ++k) {
    folder_->write(fmt::format("ending/{}.png", k), "no picture");
  }
  const Result ended = run("camera m.spincat ending");
  EXPECT_EQ(ended.summary.at("failed"), 10);
  EXPECT_EQ(ended.summary.at("gave_up"), false);
  EXPECT_EQ(ended.err, "");
  folder_->write("ending/99.png", "no picture");
  const Result gave_up = run("camera m.spincat ending");
  EXPECT_EQ(gave_up.summary.at("failed"), 10);
  EXPECT_EQ(gave_up.summary.at("gave_up"), true);
}

TEST_F(CameraCommand, SaysOnATerminalThatMoreFramesCannotBeRead) {
  folder_->write("many/camera.txt", calibration_text({}));
  for (int k = 0; k < 24; ++k) {
    folder_->write(fmt::format("many/{}.png", k), k % 8 == 7 ? encode_depth_png(DepthImage(4, 3), 1000.0) : "none");
  }
  const test::OnTerminal ran = test::on_terminal(folder_->path(), 100, "env", "camera m.spincat many");
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.text.find("spincat: many/21.png: is no depth picture"), std::string::npos) << ran.text;
  EXPECT_EQ(ran.text.find("many/22.png"), std::string::npos) << ran.text;
  EXPECT_NE(ran.text.find("spincat: more frames cannot be read; they are counted at the end\n"), std::string::npos);
  EXPECT_NE(ran.text.find("21 could not be read"), std::string::npos) << ran.text;
}

// Who draws on the terminal waits for frames; a run that fails has to tell him that none will come.
TEST_F(CameraCommand, EndsOnATerminalWhenAFrameCannotBeRecorded) {
  const test::OnTerminal ran = test::on_terminal(folder_->path(), 100, "trap '' XFSZ; ulimit -f 8;",
                                                 "camera m.spincat frames --loop --record refused");
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(ran.text.find("spincat: refused/000000.png: cannot write: file too large\n"), std::string::npos)
      << ran.text;
}

TEST_F(CameraCommand, CtrlCEndsWithASummary) {
  const Running running = start({"camera", "m.spincat", "frames", "--loop", "--realtime"});
  wait_for_lines(3);
  const Result result = running.end(SIGINT);
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(result.err, "spincat: interrupted\n");
  EXPECT_GE(result.summary.at("frames"), 3);
}

TEST_F(CameraCommand, DropsFramesForASlowConsumerInBoundedMemory) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "a thread sanitizer's own memory grows";
#endif
  const fs::path pipe = folder_->path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // An address sanitizer keeps what was freed, else.
  const char* options = std::getenv("ASAN_OPTIONS");
  const std::string ours = options != nullptr ? options : "";
  setenv("ASAN_OPTIONS", (ours + ":quarantine_size_mb=0").c_str(), 1);
  const Running running = start({"camera", "m.spincat", "frames", "--loop", "--realtime"}, "pipe");
  setenv("ASAN_OPTIONS", ours.c_str(), 1);
  std::ifstream reader(pipe);
  std::string line;
  ASSERT_TRUE(std::getline(reader, line));
  const auto memory = [&] {  // kilobytes in use
    std::ifstream status(fmt::format("/proc/{}/status", running.pid));
    for (std::string each; std::getline(status, each);) {
      if (each.rfind("VmRSS:", 0) == 0) {
        return std::stol(each.substr(6));
      }
    }
    return 0L;
  };
  const auto read_dropped = [&] { return Json::parse(line).at("dropped").get<long>(); };
  // The pipe holds 64 kB: some fifty frames. Then it waits for us.
  std::this_thread::sleep_for(std::chrono::milliseconds(2200));
  const long before = memory();
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const long after = memory();
  EXPECT_GT(before, 0);
  EXPECT_LT(after - before, 4'000);  // of the 30 frames (of 1.2 MB each) meanwhile at most a few are kept
  long dropped = 0;
  for (int k = 0; k < 150 && dropped <= 20 && std::getline(reader, line); ++k) {
    dropped = read_dropped();
  }
  EXPECT_GT(dropped, 20);
  kill(running.pid, SIGKILL);
  running.end(0);
}

TEST_F(CameraCommand, WarnsOfAModelThatWasTaughtForSomethingElse) {
  EXPECT_EQ(run("train shapes -o meshes.spincat --copies 1 --points 256 --spin-points 32 --background 8").code, 0);
  const Result result = run("camera meshes.spincat frames");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find("was trained for any, not for what a camera sees"), std::string::npos);
  EXPECT_EQ(run("camera meshes.spincat frames --quiet").err, "");
}

TEST_F(CameraCommand, RefusesWrongUseInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Result result = run("camera " + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  };
  refused("m.spincat nowhere", "nowhere: no such file");
  refused("m.spincat shapes", "holds no depth pictures");
  refused("shapes/box/0.off frames", "is not a spincat file");
  refused("m.spincat frames --up-direction 0,1", "expected three numbers");
  refused("m.spincat frames --up-direction 0,0,0", "up");
  refused("m.spincat frames --view 99999", "expected a port");
  refused("m.spincat frames --view ::1", "--view ::1: expected a port from 0 to 65535, or ADDRESS:PORT");
  refused("m.spincat frames --view [::1:80", "expected a port");
  refused("m.spincat frames --view [::1]", "expected a port");
  refused("m.spincat frames --split round", "--split");
  refused("m.spincat frames --intrinsics nothing.txt", "nothing.txt");
  refused("m.spincat frames --every 0", "--every");
  refused("m.spincat frames --units -5", "--units");
}

}  // namespace
}  // namespace spincat
