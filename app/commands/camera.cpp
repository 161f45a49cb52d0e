#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/camera/camera_painter.h"
#include "app/camera/camera_state.h"
#include "app/camera/frame_feed.h"
#include "app/camera/frame_writer.h"
#include "app/camera/freenect_source.h"
#include "app/camera/live_view.h"
#include "app/commands/commands.h"
#include "app/options.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "app/terminal/parse_errors.h"
#include "spincat/classify/recogniser.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/error.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/report/camera_report.h"
#include "spincat/settings/setting_names.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

struct CameraArguments {
  fs::path model;
  std::string source;
  std::string split = "none";
  std::string scene = "auto";
  std::size_t every = 1;
  bool real_time = false;
  FrameSettings frames;
  std::optional<std::string> up;
  std::optional<double> reject;
  fs::path record;
  fs::path masks;
  fs::path clouds;
  std::optional<std::string> view;
  RunOptions run;
};

// "0,-1,0.5" as a direction. Throws InputError.
Eigen::Vector3f parse_direction(const std::string& text) {
  Eigen::Vector3f v;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, v[i]);
    const bool followed = i < 2 ? next != end && *next == ',' : next == end;
    if (error != std::errc{} || !followed) {
      throw InputError(fmt::format("--up-direction {}: expected three numbers, as in 0,-1,0", text));
    }
    at = next + (i < 2 ? 1 : 0);
  }
  return v;
}

RecogniserSettings recogniser_settings(const CameraArguments& a) {
  RecogniserSettings settings;
  settings.segment.split = a.split == "concave" ? SegmentSplit::concave : SegmentSplit::none;
  settings.table.scene = a.scene == "table"   ? SceneKind::table
                         : a.scene == "floor" ? SceneKind::floor
                                              : SceneKind::automatic;
  settings.reject = a.reject;
  if (a.up) {
    settings.table.up = parse_direction(*a.up);
  }
  settings.validate();
  return settings;
}

// Frames a second over the last moments.
class FrameRate {
 public:
  double count() {
    constexpr double kWeight = 0.1;  // of the newest frame
    const double seconds = watch_.lap();
    mean_ = mean_ > 0.0 ? (1.0 - kWeight) * mean_ + kWeight * seconds : seconds;
    return mean_ > 0.0 ? 1.0 / mean_ : 0.0;
  }

 private:
  Stopwatch watch_;
  double mean_ = 0.0;
};

// Tells those who show frames that there are no more, however the run ends: they would wait for ever.
class EndOfFrames {
 public:
  explicit EndOfFrames(CameraState& state) : state_(state) {}
  ~EndOfFrames() { state_.end(); }
  EndOfFrames(const EndOfFrames&) = delete;
  EndOfFrames& operator=(const EndOfFrames&) = delete;

 private:
  CameraState& state_;
};

// One run: where frames come from, who looks at them, and all who are told.
class CameraRun {
 public:
  CameraRun(const CameraArguments& arguments, const Model& model, int threads)
      : arguments_(arguments),
        model_(model),
        json_(arguments.run.json || isatty(STDOUT_FILENO) == 0),
        recogniser_(model, recogniser_settings(arguments), threads) {
    // The source first: what is wrong with it is told before any folder is made.
    std::unique_ptr<FrameSource> source =
        is_kinect() ? open_kinect(arguments.frames) : open_recording(arguments.source, arguments.frames);
    for (const std::string& note : source->notes()) {
      if (!arguments.run.quiet) {
        message(note);
      }
    }
    if (!arguments.record.empty() || !arguments.masks.empty() || !arguments.clouds.empty()) {
      writer_.emplace(!arguments.real_time);
    }
    if (!arguments.record.empty()) {
      recorder_.emplace(arguments.record, *writer_);
    }
    if (!arguments.masks.empty()) {
      masks_.emplace(arguments.masks, *writer_);
    }
    if (!arguments.clouds.empty()) {
      clouds_.emplace(arguments.clouds, *writer_);
    }
    if (arguments.view) {
      view_.emplace(ViewPlace::parse(*arguments.view), state_, model.categories());
      message("watch at " + view_->url());
    }
    if (!json_) {
      painter_.emplace(state_, model.categories());
    }
    feed_ = arguments.real_time || is_kinect() ? feed_in_real_time(std::move(source), arguments.every)
                                               : feed_all(std::move(source), arguments.every);
  }

  // To the last frame, or until it is interrupted.
  void run() {
    try {
      while (!feed_->ended()) {
        stop_if_interrupted();
        if (std::optional<FedFrame> fed = feed_->next()) {
          handle(std::move(*fed));
        }
      }
    } catch (const Interrupted&) {
      finish();
      throw;
    }
    finish();
  }

  const CameraSummary& summary() const { return summary_; }

 private:
  bool is_kinect() const { return arguments_.source == "freenect:"; }

  void handle(FedFrame fed) {
    summary_.dropped = fed.dropped;
    if (!fed.error.empty()) {
      ++summary_.failed;
      report_failure(fed);
      return;
    }
    SeenFrame seen = recogniser_.look(fed.frame.image, fed.frame.intrinsics);
    const FrameFacts facts{
        fed.number,       fed.frame.name, fed.frame.time, fed.frame.image.width, fed.frame.image.height,
        fed.read_seconds, fed.dropped};
    ++summary_.frames;
    summary_.objects += seen.objects.size();
    summary_.look.add(seen.seconds.all());
    summary_.read.add(fed.read_seconds);
    if (json_) {
      fmt::print("{}\n", frame_json(facts, seen, model_.categories()));
      std::fflush(stdout);
    }
    if (recorder_) {
      recorder_->add(fed.frame);
    }
    if (masks_) {
      masks_->add(fed.number, seen, fed.frame.image.width, fed.frame.image.height);
    }
    if (clouds_) {
      clouds_->add(fed.number, seen, fed.frame.image, fed.frame.intrinsics);
    }
    if (view_ || painter_) {
      state_.show(std::make_shared<const ShownFrame>(
          ShownFrame{facts, std::move(fed.frame.image), std::move(seen), rate_.count()}));
    }
  }

  void report_failure(const FedFrame& fed) {
    constexpr std::size_t kMostMessages = 20;
    if (json_) {
      fmt::print("{}\n", frame_error_json(fed.number, fed.error));
    } else if (summary_.failed <= kMostMessages) {
      message(fed.error);
    } else if (summary_.failed == kMostMessages + 1) {
      message("more frames cannot be read; they are counted at the end");
    }
  }

  void finish() {
    summary_.wall_seconds = watch_.lap();
    state_.end();
    if (painter_) {
      painter_->finish();
    }
    if (writer_) {
      writer_->finish();
    }
    if (recorder_) {
      recorder_->finish();
    }
    if (recorder_ && recorder_->left_out() > 0) {
      message(fmt::format("{} frames came too fast to be recorded", recorder_->left_out()));
    }
    if (masks_ && masks_->left_out() > 0) {
      message(fmt::format("{} frames came too fast for their masks to be written", masks_->left_out()));
    }
    if (clouds_ && clouds_->left_out() > 0) {
      message(fmt::format("{} frames came too fast for their clouds to be written", clouds_->left_out()));
    }
    summary_.gave_up = feed_->gave_up();
    if (summary_.gave_up) {
      message("ten frames in a row could not be read: those after them were not looked at");
    }
    if (json_) {
      fmt::print("{}\n", summary_json(summary_));
    } else {
      fmt::print("{}", summary_text(summary_));
    }
    std::fflush(stdout);
  }

  const CameraArguments& arguments_;
  const Model& model_;
  bool json_;
  Recogniser recogniser_;
  CameraState state_;
  CameraSummary summary_;
  FrameRate rate_;
  Stopwatch watch_;
  std::optional<FrameRecorder> recorder_;
  std::optional<MaskWriter> masks_;
  std::optional<CloudWriter> clouds_;
  // Those with threads come last, so that they end first; what the writer still has to do is the recorder's.
  std::optional<WriterThread> writer_;
  std::optional<LiveView> view_;
  std::optional<CameraPainter> painter_;
  EndOfFrames end_{state_};
  std::unique_ptr<FrameFeed> feed_;
};

int run_camera(const CameraArguments& arguments) {
  const Model model = read_model(arguments.model);
  if (model.settings().trained_for != TrainedFor::views && !arguments.run.quiet) {
    message(fmt::format(
        "{}: was trained for {}, not for what a camera sees; names will often be wrong (train --views 12 learns that)",
        arguments.model.string(), name_of(model.settings().trained_for)));
  }
  CameraRun run(arguments, model, arguments.run.thread_count());
  run.run();
  return run.summary().failed > 0 ? 2 : 0;
}

void add_source_options(CLI::App& command, CameraArguments& a) {
  command
      .add_option("--intrinsics", a.frames.calibration,
                  "A file with the lines fx, fy, cx, cy (and units_per_metre, width, height), a 3 x 3 matrix, or what "
                  "Open3D, RealSense and ROS write; without it, the recording's own, else a Kinect's")
      ->type_name("FILE");
  command
      .add_option("--units", a.frames.units_per_metre,
                  "Numbers in depth pictures that make a metre: 1000, 5000 (TUM), 10000 (YCB)")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command.add_option("--every", a.every, "Look at every N-th frame only")
      ->check(in_range({1, 1'000'000}))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--realtime", a.real_time,
                   "Take frames in their own time, and drop those that come while another is looked at");
  command.add_flag("--loop", a.frames.loop, "After the last frame begin again");
  add_growth_option(command, a.frames.limits);
}

}  // namespace

Command add_camera(CLI::App& parent) {
  auto arguments = std::make_shared<CameraArguments>();
  CLI::App* command = parent.add_subcommand("camera", "Name what a depth camera sees, frame by frame");
  command->footer(
      "Example:\n"
      "  spincat train furniture/ --views 12 -o views.spincat\n"
      "  spincat camera views.spincat recording/ --view 8080\n"
      "  spincat camera views.spincat recording/ --split concave --json > names.jsonl");
  command->add_option("model", arguments->model, "A model file written by spincat train --views N")
      ->type_name("MODEL")
      ->required();
  command
      ->add_option(
          "source", arguments->source,
          "A folder of 16-bit depth PNG files or of organized PCD files, or one such file; freenect: for a Kinect")
      ->type_name("SOURCE")
      ->required();
  add_source_options(*command, *arguments);
  command
      ->add_option("--split", arguments->split,
                   "none: what stands together is one object (furniture, things with legs); concave: parted along "
                   "grooves (boxes that touch)")
      ->check(CLI::IsMember({"concave", "none"}))
      ->type_name("HOW")
      ->capture_default_str();
  command
      ->add_option("--scene", arguments->scene,
                   "What things stand on: auto (the plane with most readings, or a table well seen over it), table "
                   "(the highest plane) or floor (the lowest)")
      ->check(CLI::IsMember({"auto", "table", "floor"}))
      ->type_name("WHAT")
      ->capture_default_str();
  command
      ->add_option("--up-direction", arguments->up,
                   "What is up for the camera, as x,y,z (x right, y down, z forward): tells a table from a wall")
      ->type_name("X,Y,Z");
  command
      ->add_option(
          "--reject", arguments->reject,
          "Answer 'unknown' where an object is less known than this (0: name everything; default: the model's choice)")
      ->check(in_range({0.0, 1.0}))
      ->type_name("P");
  command->add_option("--record", arguments->record, "Also keep the frames: a folder that SOURCE may name later")
      ->type_name("DIR");
  command->add_option("--masks", arguments->masks, "For each frame write a 16-bit PNG of the objects' ids")
      ->type_name("DIR");
  command
      ->add_option("--clouds", arguments->clouds,
                   "For each frame write the points of each object and of the table as PLY files, in metres")
      ->type_name("DIR");
  command
      ->add_option(
          "--view", arguments->view,
          "Serve a live page on 127.0.0.1; with ADDRESS:PORT ([::1]:8080) elsewhere, for those who know its token")
      ->type_name("PORT");
  arguments->run.add_to(*command);
  return [arguments](TaskFarm&) { return run_camera(*arguments); };
}

}  // namespace spincat::app
