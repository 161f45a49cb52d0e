#include "spincat/camera/segment/tracks.h"

#include <gtest/gtest.h>

#include <vector>

namespace spincat {
namespace {

using Ids = std::vector<std::uint64_t>;
using Eigen::Vector3f;

Ids follow(Tracks& tracks, const std::vector<Vector3f>& centres) {
  return tracks.follow(centres);
}

TEST(Tracks, FollowThingsThatMoveALittle) {
  Tracks tracks;
  EXPECT_EQ(follow(tracks, {{0, 0, 1}, {0.3F, 0, 1}}), (Ids{1, 2}));
  EXPECT_EQ(follow(tracks, {{0.02F, 0, 1}, {0.28F, 0, 1}}), (Ids{1, 2}));
  EXPECT_EQ(follow(tracks, {{0.26F, 0, 1}, {0.04F, 0, 1}}), (Ids{2, 1}));  // in whatever order they are found
}

TEST(Tracks, KeepThingsApartThatSwapPlaces) {
  Tracks tracks;
  for (int k = 0; k <= 20; ++k) {
    const float x = 0.03F * static_cast<float>(k) - 0.3F;
    EXPECT_EQ(follow(tracks, {{x, 0.01F, 1}, {-x, -0.01F, 1}}), (Ids{1, 2})) << k;
  }
}

TEST(Tracks, FindAThingAgainThatWasHidden) {
  Tracks tracks;
  follow(tracks, {{0, 0, 1}});
  follow(tracks, {{0.02F, 0, 1}});
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(follow(tracks, {}), Ids{});
  }
  EXPECT_EQ(follow(tracks, {{0.14F, 0, 1}}), Ids{1});
}

TEST(Tracks, ForgetWhatIsGone) {
  Tracks tracks({0.12F, 3});
  follow(tracks, {{0, 0, 1}});
  for (int k = 0; k < 3; ++k) {
    follow(tracks, {});
    EXPECT_TRUE(tracks.forgotten().empty());
  }
  follow(tracks, {});
  EXPECT_EQ(tracks.forgotten(), Ids{1});
  EXPECT_EQ(follow(tracks, {{0, 0, 1}}), Ids{2});
}

TEST(Tracks, NumberWhatIsFarFromAllAsNew) {
  Tracks tracks;
  EXPECT_EQ(follow(tracks, {{0, 0, 1}}), Ids{1});
  EXPECT_EQ(follow(tracks, {{0.5F, 0, 1}, {0, 0, 1}}), (Ids{2, 1}));
}

}  // namespace
}  // namespace spincat
