#include "spincat/describe/table_rows.h"

#include <gtest/gtest.h>

#include "spincat/encode/feature_vector.h"
#include "spincat/error.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

std::vector<FeatureVector> object(float first, std::size_t length = 3, std::size_t rows = 2) {
  std::vector<FeatureVector> features(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    features[i].values.assign(length, first + static_cast<float>(i));
  }
  return features;
}

void put(TableRows& rows, std::size_t object, const std::vector<FeatureVector>& features) {
  std::vector<FeatureBytes> values;
  for (const FeatureVector& vector : features) {
    values.emplace_back(std::span<const float>(vector.values));
  }
  rows.put(object, values);
}

TEST(TableRows, GivesTheRowsOfTheObjectsAskedForInOrder) {
  TableRows rows(5, 2);
  put(rows, 4, object(40));
  put(rows, 0, object(0));
  put(rows, 3, object(30));
  put(rows, 3, object(30));  // twice is once
  const FeatureMatrix features = rows.take(std::vector<std::uint32_t>{0, 3, 4});
  ASSERT_EQ(features.rows(), 6);
  ASSERT_EQ(features.cols(), 3);
  const float expected[] = {0, 1, 30, 31, 40, 41};
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_EQ(features.row(i), Eigen::RowVectorXf::Constant(3, expected[i])) << i;
  }
}

TEST(TableRows, KeepsTheLongestOnly) {
  TableRows rows(4, 2);
  put(rows, 0, object(0, 2));
  EXPECT_EQ(rows.length(), 2U);
  put(rows, 2, object(20, 5));
  put(rows, 3, object(30, 4));
  std::vector<FeatureVector> uneven = object(10, 5);
  uneven[1].values.pop_back();
  put(rows, 1, uneven);
  EXPECT_EQ(rows.length(), 5U);
  for (const std::uint32_t shorter : {0U, 1U, 3U}) {
    TableRows copy = rows;
    test::expect_error<RunError>([&] { copy.take(std::vector<std::uint32_t>{shorter}); },
                                 "the rows of a feature table are not all there");
  }
  EXPECT_EQ(rows.take(std::vector<std::uint32_t>{2}).cols(), 5);
}

TEST(TableRows, TakesNothingThatCannotBe) {
  TableRows rows(2, 2);
  for (const auto& [where, what] :
       {std::pair(2, object(0)), std::pair(0, object(0, 3, 1)), std::pair(0, object(0, 3, 3))}) {
    test::expect_error<RunError>([&, at = where, &item = what] { put(rows, static_cast<std::size_t>(at), item); },
                                 "an object came with another number of feature vectors");
  }
  EXPECT_EQ(rows.take({}).rows(), 0);
}

}  // namespace
}  // namespace spincat
