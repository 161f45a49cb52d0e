#include "app/camera/frame_feed.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#include "spincat/describe/stopwatch.h"
#include "spincat/error.h"
#include "spincat/geometry/start_thread.h"

namespace spincat::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostFailures = 10;               // in a row
constexpr double kLongestGap = 5.0;             // seconds from a frame to the next: more is a damaged time
constexpr std::chrono::milliseconds kWait(50);  // so long Ctrl-C waits for a frame

// Reads one frame after the other and counts them.
class FrameReader {
 public:
  FrameReader(std::unique_ptr<FrameSource> source, std::size_t every) : source_(std::move(source)), every_(every) {}

  // Nothing after the last frame.
  std::optional<FedFrame> read() {
    for (; number_ % every_ != 0; ++number_) {
      source_->skip();
    }
    if (failures_ == kMostFailures) {
      gave_up_ = another_follows();
      return {};
    }
    FedFrame fed;
    fed.number = number_++;
    Stopwatch watch;
    try {
      std::optional<Frame> frame = source_->next();
      if (!frame) {
        return {};
      }
      fed.frame = std::move(*frame);
      failures_ = 0;
    } catch (const InputError& error) {
      fed.error = error.what();
      ++failures_;
    }
    fed.read_seconds = watch.lap();
    return fed;
  }
  bool gave_up() const { return gave_up_; }

 private:
  bool another_follows() {
    try {
      return source_->next().has_value();
    } catch (const InputError&) {
      return true;
    }
  }

  std::unique_ptr<FrameSource> source_;
  std::size_t every_;
  std::size_t number_ = 0;
  int failures_ = 0;
  std::atomic<bool> gave_up_ = false;  // asked for while another thread reads
};

// When frames are due, in seconds after the first. A list may name any times: one of them, damaged, would hold the run
// up for years, or hurry all that come after it. So what is added up are the gaps, none of them negative and none too
// long.
class Schedule {
 public:
  double next(std::size_t number, double time) {
    if (number_) {
      const double gap = time - time_;
      const double longest = kLongestGap * static_cast<double>(number - *number_);
      due_ += gap > 0.0 ? std::min(gap, longest) : 0.0;  // not of NaN
    }
    number_ = number;
    time_ = time;
    return due_;
  }

 private:
  std::optional<std::size_t> number_;  // of the last frame
  double time_ = 0.0;
  double due_ = 0.0;
};

class AllFrames : public FrameFeed {
 public:
  AllFrames(std::unique_ptr<FrameSource> source, std::size_t every) : reader_(std::move(source), every) {}

  std::optional<FedFrame> next() override {
    std::optional<FedFrame> frame = reader_.read();
    ended_ = !frame;
    return frame;
  }
  bool ended() const override { return ended_; }
  bool gave_up() const override { return reader_.gave_up(); }

 private:
  FrameReader reader_;
  bool ended_ = false;
};

class NewestFrames : public FrameFeed {
 public:
  NewestFrames(std::unique_ptr<FrameSource> source, std::size_t every)
      : reader_(std::move(source), every),
        thread_(start_thread([this](const std::stop_token& stop) { read_on(stop); })) {}

  std::optional<FedFrame> next() override {
    std::optional<FedFrame> frame = latest_.take(kWait);
    if (frame) {
      frame->dropped = dropped_;
    } else if (latest_.closed() && problem_) {
      std::rethrow_exception(std::exchange(problem_, nullptr));
    }
    return frame;
  }
  bool ended() const override { return latest_.closed() && !problem_; }
  bool gave_up() const override { return reader_.gave_up(); }

 private:
  // What goes wrong here is told to who asks for the next frame: out of a thread it would end the process.
  void read_on(const std::stop_token& stop) {
    try {
      hand_on(stop);
    } catch (...) {
      problem_ = std::current_exception();
    }
    latest_.close();
  }

  void hand_on(const std::stop_token& stop) {
    const auto start = Clock::now();
    Schedule schedule;
    while (!stop.stop_requested()) {
      std::optional<FedFrame> frame = reader_.read();
      if (!frame) {
        break;
      }
      if (frame->error.empty()) {
        const std::chrono::duration<double> offset(schedule.next(frame->number, frame->frame.time));
        wait_until(start + std::chrono::duration_cast<Clock::duration>(offset), stop);
      }
      dropped_ += latest_.put(std::move(*frame)) ? 1 : 0;
    }
  }

  static void wait_until(Clock::time_point when, const std::stop_token& stop) {
    while (!stop.stop_requested() && Clock::now() < when) {
      std::this_thread::sleep_until(std::min(when, Clock::now() + kWait));
    }
  }

  FrameReader reader_;
  Latest<FedFrame> latest_;
  std::atomic<std::size_t> dropped_ = 0;
  std::exception_ptr problem_;  // the thread's until `latest_` is closed
  std::jthread thread_;         // the last member: it uses the others
};

}  // namespace

std::unique_ptr<FrameFeed> feed_all(std::unique_ptr<FrameSource> source, std::size_t every) {
  return std::make_unique<AllFrames>(std::move(source), every);
}

std::unique_ptr<FrameFeed> feed_in_real_time(std::unique_ptr<FrameSource> source, std::size_t every) {
  return std::make_unique<NewestFrames>(std::move(source), every);
}

}  // namespace spincat::app
