// The spincat command as a user meets it: exit codes, streams, files.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/lasting_part.h"
#include "support/temp_dir.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    result.push_back(line);
  }
  return result;
}

// A box (8 corners) as an OFF file.
std::string box_off(double x, double y, double z) {
  std::string off = "OFF\n8 6 0\n";
  for (int i = 0; i < 8; ++i) {
    off += fmt::format("{} {} {}\n", (i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0);
  }
  return off + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

// A cone with 16 sides as an OFF file.
std::string cone_off(double radius, double height) {
  std::string off = fmt::format("OFF\n17 17 0\n0 0 {}\n", height);
  std::string base = "16";
  for (int i = 0; i < 16; ++i) {
    off += fmt::format("{} {} 0\n", radius * std::cos(i * 0.3926990817), radius * std::sin(i * 0.3926990817));
    base += fmt::format(" {}", 16 - i);
  }
  for (int i = 0; i < 16; ++i) {
    off += fmt::format("3 0 {} {}\n", 1 + i, 1 + (i + 1) % 16);
  }
  return off + base + "\n";
}

class Command : public testing::Test {
 protected:
  struct Result {
    int code = -1;
    std::string out;
    std::string err;
  };

  // Runs the command in the temporary folder through the shell, so that redirections can be tested; `before` is done
  // there, too.
  Result run(const std::string& arguments, const std::string& redirect = "", const std::string& before = "true") {
    const fs::path out = dir_.path() / ".out";
    const fs::path err = dir_.path() / ".err";
    const std::string line = fmt::format("cd '{}' && {} && '{}' {} >'{}' 2>'{}' </dev/null {}", dir_.path().string(),
                                         before, SPINCAT_COMMAND, arguments, out.string(), err.string(), redirect);
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(err)};
  }

  // Two categories of six objects, and one of each that is new.
  void make_shapes() {
    for (int i = 0; i < 6; ++i) {
      dir_.write(fmt::format("shapes/box/{}.off", i), box_off(1.0 + 0.1 * i, 1.0, 1.2));
      dir_.write(fmt::format("shapes/cone/{}.off", i), cone_off(0.5, 1.0 + 0.1 * i));
    }
    dir_.write("new box.off", box_off(1.0, 1.15, 0.95));
    dir_.write("new-cone.off", cone_off(0.55, 1.3));
  }

  void train() {
    make_shapes();
    const Result result =
        run("train shapes -o shapes.spincat --copies 1 --background 8 --points 256 --spin-points 32 --threads 2");
    ASSERT_EQ(result.code, 0) << result.err;
  }

  std::size_t files_in_dir() {
    std::size_t n = 0;
    for (const auto& entry : fs::directory_iterator(dir_.path())) {
      n += entry.path().filename() == ".out" || entry.path().filename() == ".err" ? 0 : 1;
    }
    return n;
  }

  spincat::test::TempDir dir_;
};

TEST_F(Command, TrainsAndNamesNewObjects) {
  train();
  const Result result = run("classify shapes.spincat 'new box.off' new-cone.off");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto rows = lines(result.out);
  ASSERT_EQ(rows.size(), 3U) << result.out;
  EXPECT_EQ(rows[0].substr(0, 4), "file");
  EXPECT_EQ(rows[1].find("new box.off   box"), 0U) << rows[1];
  EXPECT_EQ(rows[2].find("new-cone.off  cone"), 0U) << rows[2];
}

TEST_F(Command, ClassifyJsonHasThePromisedKeysALine) {
  train();
  const Result result = run("classify shapes.spincat new-cone.off missing.off --json --votes");
  EXPECT_EQ(result.code, 2);
  const auto rows = lines(result.out);
  ASSERT_EQ(rows.size(), 2U) << result.out;
  const Json named = Json::parse(rows[0]);
  EXPECT_EQ(named.at("file"), "new-cone.off");
  EXPECT_EQ(named.at("category"), "cone");
  EXPECT_GT(named.at("confidence").get<double>(), 0.5);
  EXPECT_LT(named.at("confidence").get<double>(), 1.0);
  EXPECT_EQ(named.at("votes"), Json::parse(R"({"box": 0, "cone": 1})"));
  EXPECT_GT(named.at("milliseconds").get<double>(), 0.0);
  EXPECT_EQ(named.at("judges").size(), 1U);
  const Json failed = Json::parse(rows[1]);
  EXPECT_EQ(failed.at("file"), "missing.off");
  EXPECT_EQ(failed.at("error"), "no such file");
}

TEST_F(Command, ClassifyAnswersUnknownBelowTheConfidenceAskedFor) {
  train();
  const Result never = run("classify shapes.spincat new-cone.off --json --reject 1");
  EXPECT_EQ(never.code, 0) << never.err;
  const Json json = Json::parse(never.out);
  EXPECT_EQ(json.at("category"), "unknown");
  EXPECT_EQ(json.at("best_guess"), "cone");
  EXPECT_LT(json.at("confidence").get<double>(), 1.0);
  EXPECT_NE(run("classify shapes.spincat new-cone.off --reject 1").out.find("new-cone.off  unknown "),
            std::string::npos);
  EXPECT_EQ(Json::parse(run("classify shapes.spincat new-cone.off --json --reject 0").out).at("category"), "cone");
}

TEST_F(Command, SweepWritesATableAndGoesOnFromItsJournal) {
  make_shapes();
  const std::string sweep =
      "sweep shapes --vary c=3,30 --vary spin.spin-points=16,32 --splits 2 --copies 0 --points 256 -o s.csv";
  const Result first = run(sweep);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(lines(first.out).size(), 5U) << first.out;
  const std::string csv = contents(dir_.path() / "s.csv");
  EXPECT_EQ(lines(csv)[0].rfind("c,spin_points,mean_class_rate,mean_class_rate_std,", 0), 0U) << csv;
  EXPECT_EQ(lines(csv)[4].rfind("30,32,1,0,", 0), 0U) << csv;
  EXPECT_EQ(lines(contents(dir_.path() / "s.csv.journal")).size(), 5U);
  EXPECT_EQ(run(sweep).out, first.out);  // all from the journal: even the times are the same
  EXPECT_EQ(contents(dir_.path() / "s.csv"), csv);
  const Result other = run(sweep + " --seed 2");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("s.csv.journal: is the journal of another sweep (seed differs)"), std::string::npos);
}

TEST_F(Command, OneSeedGivesTheSameBytesWhateverTheThreads) {
  make_shapes();
  ASSERT_EQ(run("train shapes -o a.spincat --copies 1 --background 8 --points 256 --spin-points 32 --threads 1").code,
            0);
  ASSERT_EQ(run("train shapes -o b.spincat --copies 1 --background 8 --points 256 --spin-points 32 --threads 3").code,
            0);
  ASSERT_EQ(run("train shapes -o c.spincat --copies 1 --background 8 --points 256 --spin-points 32 --seed 2").code, 0);
  const std::string a = contents(dir_.path() / "a.spincat");
  EXPECT_GT(a.size(), 1000U);
  EXPECT_TRUE(a == contents(dir_.path() / "b.spincat"));
  EXPECT_FALSE(a == contents(dir_.path() / "c.spincat"));
}

TEST_F(Command, EvaluateJsonHasThePromisedKeys) {
  make_shapes();
  const Result result = run("evaluate shapes --splits 3 --copies 1 --points 256 --spin-points 32 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("dataset"), "shapes");
  EXPECT_EQ(json.at("objects"), 12);
  EXPECT_EQ(json.at("categories"), Json::parse(R"(["box", "cone"])"));
  EXPECT_EQ(json.at("splits"), 3);
  EXPECT_EQ(json.at("mean_class_rate"), 1.0);
  EXPECT_EQ(json.at("mean_class_rate_std"), 0.0);
  EXPECT_EQ(json.at("overall_rate"), 1.0);
  EXPECT_EQ(json.at("overall_rate_std"), 0.0);
  EXPECT_EQ(json.at("confusion"), Json::parse("[[3, 0], [0, 3]]"));
  EXPECT_GT(json.at("seconds").get<double>(), 0.0);
}

TEST_F(Command, EvaluateTellsHowToRepeatIt) {
  make_shapes();
  const std::string small = " --copies 0 --points 256 --spin-points 32 --json";
  const Result splits = run("evaluate shapes --splits 2 --split-seeds 4,1-2" + small);
  ASSERT_EQ(splits.code, 0) << splits.err;
  const Json json = Json::parse(splits.out);
  EXPECT_EQ(json.at("run").at("split_seeds").dump(), "[4,1,2]");
  EXPECT_EQ(json.at("run").at("command").dump(),
            R"(["spincat","evaluate","shapes","--splits","2","--split-seeds","4,1-2","--copies","0","--points","256",)"
            R"("--spin-points","32","--json"])");
  EXPECT_EQ(json.at("seeds").size(), 3U);
  const Json alone = Json::parse(run("evaluate shapes --leave-one-out" + small).out);
  EXPECT_EQ(alone.at("run").at("protocol"), "leave-one-out");
  EXPECT_EQ(alone.at("confusion"), Json::parse("[[6, 0], [0, 6]]"));
}

TEST_F(Command, EvaluateLearnsFromOneDataSetAndTestsOnAnother) {
  make_shapes();
  dir_.write("list.csv", "path,category\nnew box.off,box\nnew-cone.off,cone\nnew-cone.off,cone\nlamp.off,lamp\n");
  dir_.write("lamp.off", cone_off(1, 1));
  const Result result =
      run("evaluate --train shapes --test list.csv --unknown lamp --copies 0 --background 8 --points 256 --spin-points "
          "32 --json");
  EXPECT_EQ(result.code, 2) << result.out;  // --unknown is missing
  dir_.write("lamp/a.off", cone_off(3, 1));
  const Result found =
      run("evaluate --train shapes --test list.csv --unknown lamp --copies 0 --background 8 --points 256 --spin-points "
          "32 --json");
  ASSERT_EQ(found.code, 0) << found.err;
  const Json json = Json::parse(found.out);
  EXPECT_EQ(json.at("confusion"), Json::parse("[[1, 0], [0, 1]]"));
  EXPECT_EQ(json.at("run").at("test_dataset"), "list.csv");
  EXPECT_EQ(json.at("left_out").dump(), R"([{"category":"lamp","reason":"is not in shapes"}])");
  EXPECT_EQ(json.at("confidence").at("unknown_objects"), 1);
  EXPECT_EQ(found.err, "spincat: category 'lamp' is not in shapes: left out\n");
}

TEST_F(Command, EvaluateWorksWithThePaperPreset) {
  make_shapes();
  const Result result = run("evaluate shapes --splits 2 --preset paper --bin-size 0.2rel --support-angle 90");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("mean-class rate"), std::string::npos);
}

TEST_F(Command, InfoTellsAModelFromAnObject) {
  train();
  EXPECT_EQ(Json::parse(run("info shapes.spincat --json").out).at("kind"), "model");
  const Json object = Json::parse(run("info new-cone.off --json").out);
  EXPECT_EQ(object.at("kind"), "mesh");
  EXPECT_EQ(object.at("points"), 17);
  EXPECT_EQ(object.at("triangles"), 30);
  EXPECT_EQ(run("info shapes.spincat").code, 0);
  EXPECT_EQ(run("info new-cone.off").code, 0);
}

// Everything a user can get wrong: exit code 2 and one line on standard error that says what.
TEST_F(Command, WrongUseAndBadInputAreOneLineAndExitTwo) {
  train();
  dir_.write("empty.off", "");
  dir_.write("notes.docx", "hello");
  dir_.write("damaged.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  dir_.write("same.xyz", "1 1 1\n1 1 1\n");
  dir_.write("one/box/a.off", box_off(1, 1, 1));
  dir_.write("one/box/b.off", box_off(1, 2, 1));
  dir_.write("split.csv", "path,category,split\nnew-cone.off,cone,Train\n");
  fs::create_directory(dir_.path() / "empty");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "a command is missing (spincat --help)"},
      {"frobnicate", "frobnicate"},
      {"train shapes", "--output"},
      {"train shapes -o nowhere/x.spincat", "nowhere"},
      {"train shapes -o shapes", "shapes: "},
      {"train absent -o x.spincat", "absent: "},
      {"train empty -o x.spincat", "empty: "},
      {"train one -o x.spincat", "only one category"},
      {"train shapes -o x.spincat --preset best", "preset 'best'"},
      {"train shapes -o x.spincat --image-width 0", "--image-width 0: expected 1 to 256"},
      {"train shapes -o x.spincat --bin-size 1inch", "--bin-size 1inch"},
      {"train shapes -o x.spincat --bin-size -1", "--bin-size -1: expected a number above 0"},
      {"train shapes -o x.spincat --encoding hash", "encoding 'hash'"},
      {"evaluate shapes --splits 0", "--splits 0: expected 1 to 10,000"},
      {"evaluate shapes --test-share 1", "--test-share 1: expected more than 0 and less than 1"},
      {"evaluate shapes --split-seeds 1-", "--split-seeds 1-: expected whole numbers"},
      {"evaluate shapes --split-seeds 1,2,1-3", "--split-seeds 1,2,1-3: expected up to 1000 numbers, each once"},
      {"evaluate shapes --min-objects 0", "--min-objects 0: expected 1 to 1,000,000"},
      {"evaluate shapes --split 3", "unknown option --split; did you mean --splits? (spincat evaluate --help)"},
      {"train", "train needs a DATASET (spincat train --help)"},
      {"info", "info needs a FILE (spincat info --help)"},
      {"train shapes -o x.spincat --thread 2",
       "unknown option --thread; did you mean --threads? (spincat train --help)"},
      {"info new-cone.off more.off", "unexpected argument 'more.off' (spincat info --help)"},
      {"evaluate shapes --test-as pudding", "--test-as: form 'pudding' is not known"},
      {"evaluate shapes --noise 2", "--noise 2: expected 0 to 1"},
      {"evaluate", "evaluate needs a DATASET, or --train and --test"},
      {"evaluate --train shapes", "--train requires --test"},
      {"evaluate shapes --train shapes --test shapes", "evaluate needs a DATASET, or --train and --test"},
      {"evaluate --train shapes --test shapes", "is in both data sets"},
      {"evaluate shapes --official --leave-one-out", "exclude each other"},
      {"evaluate shapes --official", "shapes: has no split of its own"},
      {"evaluate shapes --unknown absent", "absent: "},
      {"sweep shapes", "--vary"},
      {"sweep shapes --vary c", "--vary c: expected a setting and its values"},
      {"sweep shapes --vary c=1,", "--vary c=1,: expected a setting and its values"},
      {"sweep shapes --vary colour=1", "setting 'colour' is not known"},
      {"sweep shapes --vary c=1 -o s.txt", "s.txt: expected a name that ends in .json or .csv"},
      {"classify shapes.spincat new-cone.off --reject 2", "--reject 2: expected 0 to 1"},
      {"classify shapes.spincat", "classify needs at least one FILE (spincat classify --help)"},
      {"classify new-cone.off new-cone.off", "new-cone.off: is not a spincat"},
      {"classify shapes.spincat shapes.spincat", "shapes.spincat: is a spincat model, not an object"},
      {"classify shapes.spincat absent.off", "absent.off: no such file"},
      {"classify shapes.spincat empty.off", "empty.off: is empty"},
      {"classify shapes.spincat notes.docx", "notes.docx: unknown format '.docx'"},
      {"classify shapes.spincat damaged.off", "damaged.off: line 6: "},
      {"classify shapes.spincat same.xyz", "same.xyz: all its points are at one place"},
      {"classify shapes.spincat empty", "empty: holds no object files"},
      {"spin new-cone.off -o images.txt", "images.txt: expected a name that ends in .npy or .png"},
      {"spin new-cone.off -o a.npy --points-output ./a.npy",
       "./a.npy: --output and --points-output name the same file"},
      {"spin new-cone.off -o a.npy --points-output a.txt", "a.txt: expected a name that ends in .npy"},
      {"train shapes -o x.spincat --seed -1", "--seed"},
      {"train split.csv -o x.spincat", "split.csv: line 2: split 'Train' is not known"},
      {"spin absent.off -o images.npy", "absent.off: no such file"},
      {"spin new-cone.off -o images.npy --convention mine", "--convention 'mine'"},
      {"spin new-cone.off -o nowhere/images.npy", "nowhere"},
      {"info absent", "absent: "},
  };
  const std::size_t files = files_in_dir();
  for (const auto& [arguments, problem] : cases) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.err;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_EQ(lines(result.err).size(), 1U) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.rfind("spincat: ", 0), 0U) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find(problem), std::string::npos) << arguments << "\n" << result.err;
  }
  EXPECT_EQ(files_in_dir(), files);  // nothing was left behind
}

TEST_F(Command, AFullDiskIsAnErrorAndNeverAModel) {
  make_shapes();
  const Result to_full = run("train shapes -o /dev/full --copies 0 --background 8 --points 256 --spin-points 32");
  EXPECT_EQ(to_full.code, 1);
  EXPECT_EQ(to_full.err, "spincat: /dev/full: cannot write: no space left on device\n");
  const Result printed = run("--help", ">/dev/full");
  EXPECT_EQ(printed.code, 1);
  EXPECT_EQ(printed.err, "spincat: standard output: No space left on device\n");
}

TEST_F(Command, UnreadableObjectsAreSkippedOrStrict) {
  make_shapes();
  dir_.write("shapes/box/broken.off", "OFF\n1 1 0\n");
  const Result skipped = run("train shapes -o x.spincat --copies 0 --background 8 --points 256 --spin-points 32");
  EXPECT_EQ(skipped.code, 0);
  EXPECT_NE(skipped.err.find("spincat: shapes/box/broken.off: "), std::string::npos) << skipped.err;
  EXPECT_NE(skipped.err.find("(skipped)"), std::string::npos) << skipped.err;
  EXPECT_EQ(run("train shapes -o x.spincat --copies 0 --background 8 --points 256 --spin-points 32 --quiet").err, "");
  const Result strict =
      run("train shapes -o y.spincat --copies 0 --background 8 --points 256 --spin-points 32 --strict");
  EXPECT_EQ(strict.code, 2);
  EXPECT_EQ(lines(strict.err).size(), 1U) << strict.err;
  EXPECT_FALSE(fs::exists(dir_.path() / "y.spincat"));
}

TEST_F(Command, ABatchNamesTheGoodAndReportsTheBadOnce) {
  train();
  dir_.write("batch/a.off", box_off(1, 1, 1));
  dir_.write("batch/b.off", "garbage");
  dir_.write("batch/sub/c.off", cone_off(1, 2));
  dir_.write("batch/notes.txt", "passed over");
  const Result result = run("classify shapes.spincat batch --threads 2");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(lines(result.out).size(), 3U) << result.out;  // head and two rows
  ASSERT_EQ(lines(result.err).size(), 2U) << result.err;
  EXPECT_EQ(lines(result.err)[0].rfind("spincat: batch/b.off: ", 0), 0U);
  EXPECT_EQ(lines(result.err)[1], "spincat: 1 of 3 objects could not be named");
}

// Whatever is wrong with one: the others are named.
TEST_F(Command, ABatchGoesOnAfterWhatTheSystemRefuses) {
  train();
  fs::create_symlink("loop", dir_.path() / "loop");
  const std::string endless(300, 'a');
  const Result result = run("classify shapes.spincat loop " + endless + " new-cone.off/below new-cone.off");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(lines(result.out).size(), 2U) << result.out;
  const auto said = lines(result.err);
  ASSERT_EQ(said.size(), 4U) << result.err;
  EXPECT_EQ(said[0], "spincat: loop: too many levels of symbolic links");
  EXPECT_EQ(said[1], "spincat: " + endless + ": file name too long");
  EXPECT_EQ(said[2], "spincat: new-cone.off/below: not a directory");
}

TEST_F(Command, StrangersThatAreNoFilesAreListedAndTheOthersTested) {
  make_shapes();
  dir_.write("list.csv", "path\nnew box.off\npipe.off\nendless.off\n");
  ASSERT_EQ(::mkfifo((dir_.path() / "pipe.off").c_str(), 0600), 0);  // nobody writes to it
  fs::create_symlink("/dev/zero", dir_.path() / "endless.off");
  const Result result =
      run("evaluate shapes --confidence --unknown list.csv --splits 2 --copies 0 --background 8 --points 256 "
          "--spin-points 32");
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* file : {"pipe.off", "endless.off"}) {
    EXPECT_NE(result.err.find(fmt::format("spincat: {}: is not a regular file", file)), std::string::npos)
        << result.err;
  }
}

// Of a terabyte, where the command may take 4 GB.
TEST_F(Command, AnObjectThatIsTooLargeForTheMemoryEndsWhatLearns) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take more memory than the test lets the command have";
#endif
  make_shapes();
  fs::resize_file(dir_.write("shapes/box/large.off", "OFF\n"), std::uintmax_t{1} << 40);
  const std::string small = " --copies 0 --background 8 --points 256 --spin-points 32 --threads 2";
  for (const std::string command :
       {"train shapes -o x.spincat", "evaluate shapes --splits 2", "sweep shapes --vary c=3 --splits 2"}) {
    const Result result = run(command + small, "", "ulimit -v 4000000");
    EXPECT_EQ(result.code, 1) << command << "\n" << result.err;
    EXPECT_NE(result.err.find("shapes/box/large.off: not enough memory"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(dir_.path() / "x.spincat"));
  }
  fs::rename(dir_.path() / "shapes/box/large.off", dir_.path() / "large.off");
  ASSERT_EQ(run("train shapes -o x.spincat" + small).code, 0);
  const Result named = run("classify x.spincat large.off new-cone.off", "", "ulimit -v 4000000");
  EXPECT_EQ(named.code, 2);
  EXPECT_EQ(lines(named.out).size(), 2U) << named.out;
  EXPECT_NE(named.err.find("large.off: not enough memory"), std::string::npos) << named.err;
}

TEST_F(Command, ClosedStreamsAreNoReasonToCrash) {
  train();
  EXPECT_EQ(run("classify shapes.spincat absent.off", "2>&-").code, 2);
  EXPECT_EQ(run("classify shapes.spincat absent.off", "2>/dev/full").code, 2);
  EXPECT_EQ(run("classify shapes.spincat new-cone.off", ">&-").code, 1);  // the answer did not arrive
  EXPECT_EQ(run("train shapes -o x.spincat --copies 0 --background 8 --points 256 --spin-points 32", ">&- 2>&-").code,
            1);
  EXPECT_EQ(run("info x.spincat").code, 0);  // no message went into the model
}

TEST_F(Command, StrictMindsWhatTheDataSetItselfIsMissing) {
  make_shapes();
  dir_.write("list.csv", "path,category\nshapes/box/0.off,box\nshapes/cone/0.off,cone\nabsent.off,cone\n");
  const std::string small = " --copies 0 --background 8 --points 256 --spin-points 32";
  EXPECT_EQ(run("train list.csv -o x.spincat" + small).code, 0);
  const Result strict = run("train list.csv -o y.spincat --strict" + small);
  EXPECT_EQ(strict.code, 2);
  EXPECT_EQ(strict.err, "spincat: absent.off: no such file\n");
}

TEST_F(Command, ACategoryThatIsOnlyTestedIsNamed) {
  make_shapes();
  dir_.write("list.csv",
             "path,category,split\nshapes/box/0.off,box,train\nshapes/cone/0.off,cone,train\nnew-cone.off,new,test\n");
  const Result result = run("train list.csv -o x.spincat --copies 0 --background 8 --points 256 --spin-points 32");
  EXPECT_EQ(result.code, 0);
  ASSERT_EQ(lines(result.err).size(), 2U) << result.err;
  EXPECT_NE(lines(result.err)[1].find("category 'new' has objects in the test split only"), std::string::npos);
}

TEST_F(Command, AModelOnStandardOutputIsNothingButTheModel) {
  make_shapes();
  const Result model = run("train shapes -o /dev/stdout --copies 0 --background 8 --points 256 --spin-points 32");
  ASSERT_EQ(model.code, 0);
  dir_.write("piped.spincat", model.out);
  EXPECT_EQ(run("info piped.spincat").code, 0);
}

TEST_F(Command, ADamagedOrNewerModelIsRefused) {
  train();
  std::string bytes = contents(dir_.path() / "shapes.spincat");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  dir_.write("damaged.spincat", bytes);
  const Result result = run("classify damaged.spincat new-cone.off");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("damaged.spincat: is damaged"), std::string::npos) << result.err;
}

TEST_F(Command, CtrlCLeavesTheOldModelAndNothingElse) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "a thread sanitizer delivers signals when it pleases";
#endif
  make_shapes();
  dir_.write("x.spincat", "old");
  const std::size_t files = files_in_dir();
  const fs::path pid_file = dir_.path() / "shapes" / "pid";
  std::thread interrupter([&] {
    // Only once it runs: the shell writes the number of the process that then becomes the command.
    for (int i = 0; i < 500 && contents(pid_file).empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(std::stoi(contents(pid_file)), SIGINT);
  });
  const std::string line = fmt::format(
      "cd '{}' && sh -c 'echo $$ > shapes/pid; exec \"{}\" train shapes -o x.spincat --copies 100 --background 8 "
      "--points 20000' 2>.err",
      dir_.path().string(), SPINCAT_COMMAND);
  const int status = std::system(line.c_str());
  interrupter.join();
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_EQ(contents(dir_.path() / ".err"), "spincat: interrupted\n");
  EXPECT_EQ(contents(dir_.path() / "x.spincat"), "old");
  EXPECT_EQ(files_in_dir(), files);
}

TEST_F(Command, ViewsAreTaughtAndMeasuredAndClassifySaysWhatAMeshIsToThem) {
  make_shapes();
  const std::string small = " --views 3 --up z --points 256 --spin-points 32";
  EXPECT_EQ(run("train shapes -o views.spincat" + small).code, 0);
  const Result named = run("classify views.spincat 'new box.off' new-cone.off");
  EXPECT_EQ(named.code, 0);
  EXPECT_EQ(
      named.err,
      "spincat: new box.off: is a mesh, but the judges were trained by views: they see one view of it (and 1 more)"
      "\n");
  EXPECT_EQ(run("classify views.spincat new-cone.off --quiet").err, "");
  const Json measured = Json::parse(run("evaluate shapes --splits 2 --json" + small).out);
  ASSERT_EQ(measured.at("views").size(), 3U);
  EXPECT_EQ(measured.at("views")[1].at("views"), 2);
  EXPECT_EQ(measured.at("views")[2].at("mean_class_rate"), measured.at("mean_class_rate"));
  EXPECT_EQ(run("train shapes -o x.spincat --views 3 --for any").code, 2);
  EXPECT_EQ(run("train shapes -o x.spincat --for views --points 64 --spin-points 16").code, 0);
  EXPECT_EQ(run("train shapes -o x.spincat --views 3 --up none").code, 2);
}

TEST_F(Command, EverySubcommandHasHelpWithAnExample) {
  for (const std::string command :
       {"", "train", "classify", "evaluate", "sweep", "spin", "describe", "settings", "info"}) {
    const Result result = run(command + " --help");
    EXPECT_EQ(result.code, 0);
    EXPECT_NE(result.out.find("Example:"), std::string::npos) << command;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(run("--version").out.rfind("spincat ", 0), 0U);
}

TEST_F(Command, ClassifyReportIsTheSameWhateverTheThreads) {
  train();
  for (const int threads : {1, 3}) {
    const Result result =
        run(fmt::format("classify shapes.spincat 'new box.off' missing.off new-cone.off shapes/cone "
                        "--threads {0} --report {0}.html",
                        threads));
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "spincat: missing.off: no such file\nspincat: 1 of 9 objects could not be named\n");
  }
  const std::string one = spincat::test::lasting_part(contents(dir_.path() / "1.html"));
  EXPECT_GT(one.size(), 900'000U);  // with what draws it
  EXPECT_NE(one.find("id=\"object-8\""), std::string::npos);
  EXPECT_TRUE(one == spincat::test::lasting_part(contents(dir_.path() / "3.html")));
}

TEST_F(Command, EvaluateReportBringsItsPictures) {
  make_shapes();
  const Result result = run("evaluate shapes --splits 2 --copies 0 --points 200 --spin-points 16 --report r.html");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(contents(dir_.path() / "r.confusion.svg").substr(0, 4), "<svg");
  EXPECT_EQ(contents(dir_.path() / "r.confusion.png").substr(1, 3), "PNG");
}

TEST_F(Command, InfoReportShowsObjectsOnly) {
  train();
  EXPECT_EQ(run("info new-cone.off --quiet --report cone.html").code, 0);
  EXPECT_EQ(contents(dir_.path() / "cone.html").substr(0, 15), "<!doctype html>");
  const Result refused = run("info shapes.spincat --report model.html");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, "spincat: shapes.spincat: is a model, and --report shows an object\n");
  EXPECT_EQ(run("info new-cone.off --report cone.txt").code, 2);
  EXPECT_FALSE(fs::exists(dir_.path() / "model.html"));
}

// What train stores, evaluate measures, and sweep varies: one setting is one thing in all of them.
Json settings_of(const std::string& info) {
  return Json::parse(info)["settings"];
}

TEST_F(Command, WhatTheUserChoosesHoldsBesideViews) {
  make_shapes();
  const Result trained = run("train shapes -o v.spincat --views 2 --points 500 --image-width 16 --spin-points 32");
  ASSERT_EQ(trained.code, 0) << trained.err;
  const Json settings = settings_of(run("info v.spincat --json").out);
  EXPECT_EQ(settings["points"], 500);
  EXPECT_EQ(settings["image_width"], 16);
  EXPECT_EQ(settings["trained_for"], "views");
  const std::string text = run("info v.spincat").out;
  for (const char* fact : {"views 2", "up y", "kernel linear", "c 10"}) {
    EXPECT_NE(text.find(fact), std::string::npos) << fact << "\n" << text;
  }
}

TEST_F(Command, SweepMeasuresWhatTrainAndEvaluateDo) {
  make_shapes();
  const std::string small = " --copies 1 --points 256 --spin-points 32 --splits 2 --quiet --json";
  const std::string views = " --points 256 --spin-points 32 --splits 2 --quiet --json";
  const auto rate = [](const Json& json) { return json["mean_class_rate"].get<double>(); };
  for (const auto& [vary, options, more] : std::vector<std::array<std::string, 3>>{
           {"kernel=linear,rbf", "--kernel rbf", small},
           {"encoding=mean-image,bag-of-features", "--encoding bag-of-features", small},
           {"views=1,3", "--views 3", views}}) {
    const Result swept = run("sweep shapes --vary " + vary + more);
    ASSERT_EQ(swept.code, 0) << swept.err;
    const Json sweep = Json::parse(swept.out);
    ASSERT_EQ(sweep["points"].size(), 2U);
    EXPECT_FALSE(sweep["settings"].contains(vary.substr(0, vary.find('=')))) << vary;
    const Result evaluated = run("evaluate shapes " + options + more);
    ASSERT_EQ(evaluated.code, 0) << evaluated.err;
    EXPECT_EQ(rate(sweep["points"][1]), rate(Json::parse(evaluated.out))) << vary;
  }
  EXPECT_EQ(settings_of(run("evaluate shapes --kernel rbf" + small).out)["c"], 3.0);
  ASSERT_EQ(run("train shapes -o k.spincat --kernel rbf --copies 1 --points 256 --spin-points 32").code, 0);
  EXPECT_EQ(settings_of(run("info k.spincat --json").out)["c"], 3.0);
}

TEST_F(Command, EverySettingIsAnOption) {
  const Json list = Json::parse(run("settings --json").out)["settings"];
  EXPECT_EQ(list.size(), 28U);
  const std::string help = run("train --help").out;
  for (const Json& setting : list) {
    EXPECT_NE(help.find(setting["option"].get<std::string>() + " "), std::string::npos) << setting;
  }
  EXPECT_NE(help.find("(default 256; paper 100)"), std::string::npos) << help;
  EXPECT_NE(run("settings").out.find("spin_points    1 to 10,000,000"), std::string::npos);
}

// The header and the numbers of a .npy file of two dimensions.
std::pair<std::string, std::string> npy_parts(const std::string& bytes) {
  const std::size_t end = bytes.find('\n') + 1;
  return {bytes.substr(0, end), bytes.substr(end)};
}

TEST_F(Command, DescribeWritesTheFeaturesOfManyObjects) {
  make_shapes();
  dir_.write("damaged.off", "OFF\n3 1 0\n");
  const std::string small = " --points 256 --spin-points 32";
  const Result all = run("describe shapes damaged.off new-cone.off -o all.npy --threads 2" + small);
  EXPECT_EQ(all.code, 2) << all.err;
  EXPECT_EQ(lines(all.err).size(), 1U) << all.err;
  const auto [header, numbers] = npy_parts(contents(dir_.path() / "all.npy"));
  EXPECT_NE(header.find("(13, 14400, )"), std::string::npos) << header;
  EXPECT_EQ(numbers.size(), 13U * 14400U * 4U);
  const std::vector<std::string> names = lines(contents(dir_.path() / "all.csv"));
  ASSERT_EQ(names.size(), 14U);
  EXPECT_EQ(names[0], "row,path,kind");
  EXPECT_EQ(names[13], "12,new-cone.off,mesh");
  ASSERT_EQ(run("describe new-cone.off -o one.npy" + small).code, 0);
  EXPECT_TRUE(npy_parts(contents(dir_.path() / "one.npy")).second == numbers.substr(12U * 14400U * 4U));
}

TEST_F(Command, DescribeRefusesInOneLine) {
  make_shapes();
  for (const auto& [arguments, problem] : std::vector<std::pair<std::string, std::string>>{
           {"describe shapes -o f.txt", "f.txt: expected a name that ends in .npy"},
           {"describe shapes -o nowhere/f.npy", "nowhere"},
           {"describe shapes -o f.npy --encoding pooled-pyramid --image-width 20", "divisible by 8"},
           {"describe shapes -o f.npy --spin-points many", "--spin-points many: expected a whole number"}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments << result.err;
    EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
    EXPECT_NE(result.err.find(problem), std::string::npos) << result.err;
  }
  EXPECT_EQ(run("describe absent.off -o f.npy").code, 2);
  EXPECT_FALSE(fs::exists(dir_.path() / "f.npy"));
  EXPECT_FALSE(fs::exists(dir_.path() / "f.csv"));
}

}  // namespace
