#include "spincat/io/formats/object_builder.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace spincat::io {
namespace {

TEST(ObjectBuilder, LetsNoCornerThroughThatIsNoVertex) {
  ObjectBuilder early({});
  early.add_triangle(0, 1, 2);  // some formats have their faces before their vertices
  for (int i = 0; i < 3; ++i) {
    early.add_vertex({0, 0, 1.0 * i});
  }
  EXPECT_EQ(std::get<Mesh>(early.finish()).triangles.size(), 1U);

  for (const Triangle& bad : {Triangle{3, 0, 1}, Triangle{0, 3, 1}, Triangle{0, 1, 3}}) {
    ObjectBuilder object({});
    for (int i = 0; i < 3; ++i) {
      object.add_vertex({0, 0, 1.0 * i});
    }
    object.add_triangle(bad[0], bad[1], bad[2]);
    object.add_triangle(0, 1, 2);
    EXPECT_EQ(test::input_error([&] { object.finish(); }), "vertex index 3 is out of range (3 vertices)");
  }
  ObjectBuilder empty({});
  empty.add_triangle(0, 0, 0);
  EXPECT_EQ(test::input_error([&] { empty.finish(); }), "vertex index 0 is out of range (0 vertices)");
}

}  // namespace
}  // namespace spincat::io
