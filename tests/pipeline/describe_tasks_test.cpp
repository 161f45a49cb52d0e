#include "spincat/pipeline/describe_tasks.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

#include "spincat/error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

Object some_box() {
  return test::box();
}

FeatureVector one_number(const Object&, int, StageSeconds&) {
  return {{1.0F}, {1}, "none", 0};
}

TEST(DescribeObject, GivesEveryRow) {
  const Described described = describe_object(some_box, 3, one_number);
  EXPECT_EQ(described.features.size(), 3U);
  EXPECT_EQ(described.problem, "");
}

TEST(DescribeObject, MakesAProblemOfWhatTheObjectIsToBlameFor) {
  const auto unread = [](const auto& error) {
    return describe_object([&]() -> Object { throw error; }, 2, one_number).problem;
  };
  EXPECT_EQ(unread(InputError("a.off", "is empty")), "is empty");
  EXPECT_EQ(unread(RunError("a.off", "not enough memory to read it")), "not enough memory to read it");
  EXPECT_EQ(unread(std::bad_alloc()), "not enough memory for it");
  const auto second_row_fails = [](const auto& error) {
    return describe_object(some_box, 2, [&](const Object& object, int row, StageSeconds& seconds) {
      if (row == 1) {
        throw error;
      }
      return one_number(object, row, seconds);
    });
  };
  for (const Described& described :
       {second_row_fails(InputError("has no extent")), second_row_fails(std::bad_alloc())}) {
    EXPECT_NE(described.problem, "");
    EXPECT_TRUE(described.features.empty());
  }
}

// A rank that is lost, say: the next object would not fare better.
TEST(DescribeObject, ThrowsWhatTheObjectIsNotToBlameFor) {
  EXPECT_THROW(describe_object(some_box, 1, [](auto&&...) -> FeatureVector { throw RunError("lost"); }), RunError);
  EXPECT_THROW(describe_object([]() -> Object { throw std::logic_error("no"); }, 1, one_number), std::logic_error);
}

}  // namespace
}  // namespace spincat
