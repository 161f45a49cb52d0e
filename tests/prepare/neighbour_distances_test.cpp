#include "spincat/prepare/neighbour_distances.h"

#include <gtest/gtest.h>

namespace spincat {
namespace {

TEST(NeighbourDistances, ReachTheNthNeighbour) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}};
  EXPECT_EQ(neighbour_distances(points, 1), (std::vector<double>{1, 1, 2, 4}));
  EXPECT_EQ(neighbour_distances(points, 2), (std::vector<double>{3, 2, 3, 6}));
}

TEST(NeighbourDistances, ReachTheLastWhereThereAreFewer) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(neighbour_distances(points, 8), (std::vector<double>{3, 2, 3}));
  EXPECT_EQ(neighbour_distances(std::vector<Vec3>{{1, 2, 3}}, 8), (std::vector<double>{0}));
  EXPECT_TRUE(neighbour_distances({}, 8).empty());
}

}  // namespace
}  // namespace spincat
