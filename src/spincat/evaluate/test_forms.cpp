#include "spincat/evaluate/test_forms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "spincat/error.h"
#include "spincat/evaluate/enclosed_space.h"
#include "spincat/evaluate/split_edges.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {
namespace {

constexpr std::size_t kDenseTriangles = 8'000;
constexpr double kHoleShare = 0.2;  // of the area
constexpr double kHoleEdge = 0.2;   // the longest edge of what is taken away, in radii: pieces go, not table tops
constexpr int kInnerPieces = 30;
constexpr std::array<double, 2> kInnerSizes{.05, .4};  // of a piece, along each axis, in parts of the bounding box
constexpr double kPlate = 0.02;                        // the thickness of every other piece
constexpr int kTries = 200;                            // to find a place for a piece
constexpr double kCutShare = 0.3;                      // of a cloud's points

Vec3 random_direction(Random& random) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return Vec3(x, y, z).normalized();
}

void add_noise(double amount, Random& random, Vec3& p) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    p[axis] += amount * random.normal();
  }
}

Object turned(Object object, Random& random) {
  // Four normal numbers are a random direction in four dimensions: evenly distributed unit quaternions.
  const double w = random.normal();
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  const Eigen::Matrix3d turn = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const auto turn_all = [&](std::vector<Vec3>& vectors) {
    for (Vec3& v : vectors) {
      v = turn * v;
    }
  };
  if (Mesh* mesh = std::get_if<Mesh>(&object)) {
    turn_all(mesh->vertices);
  } else {
    auto& cloud = std::get<PointCloud>(object);
    turn_all(cloud.points);
    turn_all(cloud.normals);
    if (cloud.sensor) {
      cloud.sensor = turn * *cloud.sensor;
    }
  }
  return object;
}

double diameter(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) {
    bounds.extend(p);
  }
  double furthest = 0.0;
  for (const Vec3& p : points) {
    furthest = std::max(furthest, (p - bounds.center()).norm());
  }
  return 2.0 * furthest;
}

// A cloud of the surface, with noise.
PointCloud noisy_cloud(const Object& object, const TestOptions& options, Random& random) {
  PointCloud cloud;
  if (const Mesh* mesh = std::get_if<Mesh>(&object)) {
    if (!has_area(*mesh)) {
      throw InputError("has no area to draw a cloud's points from");
    }
    const auto points = static_cast<std::size_t>(options.used_cloud_points());
    cloud.points = surface_samples(*mesh, points, random).positions;
  } else {
    cloud.points = std::get<PointCloud>(object).points;
    cloud.sensor = std::get<PointCloud>(object).sensor;
  }
  const double noise = options.used_noise();
  if (noise > 0.0) {
    const double amount = noise * diameter(cloud.points);
    for (Vec3& p : cloud.points) {
      add_noise(amount, random, p);
    }
  }
  return cloud;
}

// The cloud with the points `kept` alone, in its order.
PointCloud selected(PointCloud cloud, std::vector<std::uint32_t> kept) {
  std::ranges::sort(kept);
  std::vector<Vec3> points;
  std::ranges::transform(kept, std::back_inserter(points), [&](std::uint32_t i) { return cloud.points[i]; });
  cloud.points = std::move(points);
  return cloud;
}

std::vector<std::uint32_t> numbers_to(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

// At most so many points, drawn without replacement.
PointCloud thinned(const PointCloud& cloud, std::size_t count, Random& random) {
  std::vector<std::uint32_t> order = numbers_to(cloud.points.size());
  random.shuffle(order);
  order.resize(std::min(count, order.size()));
  return selected(cloud, std::move(order));
}

// What lies on one side of a random plane.
PointCloud cut(const PointCloud& cloud, Random& random) {
  const Vec3 direction = random_direction(random);
  std::vector<std::uint32_t> order = numbers_to(cloud.points.size());
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return cloud.points[i].dot(direction); });
  const double stays = (1.0 - kCutShare) * static_cast<double>(order.size());
  order.resize(static_cast<std::size_t>(std::lround(stays)));
  return selected(cloud, std::move(order));
}

// Vertices at one place move together: the surface stays as whole as it was. `mesh` has radius 1.
void move_vertices(double noise, Random& random, Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) {
      add_noise(2.0 * noise, random, mesh.vertices[v]);
    } else {
      mesh.vertices[v] = mesh.vertices[first[v]];
    }
  }
}

// The mesh without random faces that have a fifth of its area, or a little more.
Mesh with_holes(const Mesh& mesh, Random& random) {
  const Mesh pieces = with_split_edges(mesh, std::numeric_limits<std::size_t>::max(), kHoleEdge);
  const std::vector<Vec3> area_normals = face_area_normals(pieces);
  double left = 0.0;
  for (const Vec3& n : area_normals) {
    left += kHoleShare * n.norm();
  }
  std::vector<std::uint32_t> order = numbers_to(pieces.triangles.size());
  random.shuffle(order);
  std::vector<bool> stays(order.size(), true);
  for (auto at = order.begin(); at != order.end() && left > 0.0; ++at) {
    left -= area_normals[*at].norm();
    stays[*at] = false;
  }
  Mesh holed{pieces.vertices, {}};
  for (std::size_t f = 0; f < stays.size(); ++f) {
    if (stays[f]) {
      holed.triangles.push_back(pieces.triangles[f]);
    }
  }
  return without_unused_vertices(holed);
}

// Corner k of the box has bit 0 of k for the upper x, bit 1 for y, bit 2 for z.
void add_box(const Eigen::AlignedBox3d& box, Mesh& mesh) {
  constexpr std::array<Triangle, 12> kFaces = {{{0, 4, 6},
                                                {0, 6, 2},
                                                {1, 3, 7},
                                                {1, 7, 5},
                                                {0, 1, 5},
                                                {0, 5, 4},
                                                {2, 6, 7},
                                                {2, 7, 3},
                                                {0, 2, 3},
                                                {0, 3, 1},
                                                {4, 5, 7},
                                                {4, 7, 6}}};
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
  }
  for (const Triangle& t : kFaces) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

// A random box within the bounds, or a plate.
Eigen::AlignedBox3d random_piece(const Eigen::AlignedBox3d& bounds, bool is_plate, Random& random) {
  const Vec3 space = bounds.sizes();
  const auto flat = is_plate ? static_cast<int>(random.below(3)) : 3;
  Vec3 size;
  Vec3 at;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = space[axis] * (axis == flat ? kPlate : random.uniform(kInnerSizes[0], kInnerSizes[1]));
    at[axis] = bounds.min()[axis] + random.uniform() * (space[axis] - size[axis]);
  }
  return {at, at + size};
}

// The mesh with random boxes and plates inside, as far as it has an inside.
Mesh with_inner_pieces(const Mesh& mesh, Random& random) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& v : mesh.vertices) {
    bounds.extend(v);
  }
  const EnclosedSpace inside(mesh);
  Mesh result = mesh;
  for (int piece = 0; piece < kInnerPieces; ++piece) {
    for (int k = 0; k < kTries; ++k) {
      const Eigen::AlignedBox3d box = random_piece(bounds, piece % 2 == 1, random);
      if (inside.contains(box.min(), box.max())) {
        add_box(box, result);
        break;
      }
    }
  }
  return result;
}

// Changes a mesh while it has radius 1 around the origin: lengths and areas are of a moderate size there.
template <class Change>
Mesh at_unit_size(const Mesh& given, const Change& change) {
  const Mesh mesh = without_unused_vertices(given);
  const Similarity similarity = unit_similarity(mesh.vertices);
  Mesh result = transformed(mesh, similarity);
  result = change(result);
  for (Vec3& v : result.vertices) {
    v = v / similarity.factor + similarity.centre;
  }
  return result;
}

Mesh changed_mesh(const Mesh& mesh, const TestOptions& options, Random& random) {
  if (options.form != TestForm::noisy_mesh && !has_area(mesh)) {
    throw InputError("has no area");
  }
  Mesh result = mesh;
  switch (options.form) {
    case TestForm::dense_mesh:
      result = with_split_edges(mesh, kDenseTriangles, std::numeric_limits<double>::min());
      [[fallthrough]];
    case TestForm::noisy_mesh:
      move_vertices(options.used_noise(), random, result);
      return result;
    case TestForm::holes:
      return with_holes(mesh, random);
    case TestForm::inner:
      return with_inner_pieces(mesh, random);
    default:
      return result;
  }
}

Object mesh_form(const Object& object, const TestOptions& options, Random& random) {
  if (const Mesh* mesh = std::get_if<Mesh>(&object)) {
    return at_unit_size(*mesh, [&](const Mesh& unit) { return changed_mesh(unit, options, random); });
  }
  if (options.form == TestForm::holes || options.form == TestForm::inner) {
    throw InputError("is a cloud: only meshes have holes and inner faces");
  }
  return noisy_cloud(object, options, random);
}

}  // namespace

Object in_test_form(const Object& object, const TestOptions& options, std::uint64_t seed) {
  Random random(seed);
  switch (options.form) {
    case TestForm::turned:
      return turned(object, random);
    case TestForm::cloud:
      return noisy_cloud(object, options, random);
    case TestForm::cut:
      return cut(noisy_cloud(object, options, random), random);
    case TestForm::sparse:
      return thinned(noisy_cloud(object, options, random), static_cast<std::size_t>(options.used_cloud_points()),
                     random);
    case TestForm::noisy_mesh:
    case TestForm::dense_mesh:
    case TestForm::holes:
    case TestForm::inner:
      return mesh_form(object, options, random);
    case TestForm::as_is:
      break;
  }
  return object;
}

}  // namespace spincat
