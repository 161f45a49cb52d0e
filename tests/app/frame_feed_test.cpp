// Frames on their way from a source that fails in one way or another.
#include "app/camera/frame_feed.h"

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "spincat/error.h"

namespace spincat::app {
namespace {

// Gives a frame for each time, and then does what it is told.
class Scripted : public FrameSource {
 public:
  explicit Scripted(std::vector<double> times, std::function<std::optional<Frame>()> last = {})
      : times_(std::move(times)), last_(std::move(last)) {}

  std::optional<Frame> next() override {
    if (at_ == times_.size()) {
      return last_ ? last_() : std::nullopt;
    }
    Frame frame;
    frame.time = times_[at_++];
    return frame;
  }

 private:
  std::vector<double> times_;
  std::function<std::optional<Frame>()> last_;
  std::size_t at_ = 0;
};

using Feed = std::unique_ptr<FrameFeed> (*)(std::unique_ptr<FrameSource>, std::size_t);

// Takes all that the feed gives, the source's last word after two frames, and says how it ended.
std::string end_of(Feed feed, std::function<std::optional<Frame>()> last) {
  const std::unique_ptr<FrameFeed> fed =
      feed(std::make_unique<Scripted>(std::vector<double>{0.0, 0.01}, std::move(last)), 1);
  try {
    while (!fed->ended()) {
      fed->next();
    }
  } catch (const RunError& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "memory";
  }
  return "end";
}

TEST(FrameFeed, WhatTheSourceThrowsReachesWhoAsksForFrames) {
  using Last = std::optional<Frame>;
  for (const Feed feed : {feed_all, feed_in_real_time}) {
    EXPECT_EQ(end_of(feed, {}), "end");
    EXPECT_EQ(end_of(feed, []() -> Last { throw RunError("it was unplugged"); }), "it was unplugged");
    EXPECT_EQ(end_of(feed, []() -> Last { throw std::bad_alloc(); }), "memory");
  }
}

// Waits as long as it takes: 41 years, if that one time were believed.
TEST(FrameFeed, ADamagedTimeHoldsNothingUp) {
  const std::vector<std::vector<double>> damaged = {{0.0, 1305031453.0, 1305031453.03, 1305031453.06},
                                                    {1e308, 5.0, -1e308, -1e308}};
  for (const std::vector<double>& times : damaged) {
    const auto fed = feed_in_real_time(std::make_unique<Scripted>(times), 1);
    std::size_t last = 0;
    while (!fed->ended()) {
      if (const std::optional<FedFrame> frame = fed->next()) {
        last = frame->number;
      }
    }
    EXPECT_EQ(last, 3U);
  }
}

}  // namespace
}  // namespace spincat::app
