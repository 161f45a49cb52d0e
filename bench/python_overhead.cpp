// The C++ call that bench/python_overhead.py measures Python's against: milliseconds of every repetition, a line each.
//
//   spincat_python_overhead POINTS COUNT KEYPOINTS REPEATS THREADS
//
// POINTS holds COUNT rows of six 32-bit floats: positions and normals; the first KEYPOINTS rows are the spin points.
#include <spincat/spincat.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace {

spincat::OrientedPoints first_rows(const std::vector<float>& rows, std::size_t count) {
  spincat::OrientedPoints points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* row = rows.data() + 6 * i;
    points.set(i, {row[0], row[1], row[2]}, {row[3], row[4], row[5]});
  }
  return points;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: spincat_python_overhead POINTS COUNT KEYPOINTS REPEATS THREADS\n");
    return 2;
  }
  try {
    const auto count = static_cast<std::size_t>(std::atoll(argv[2]));
    const auto keypoints = static_cast<std::size_t>(std::atoll(argv[3]));
    std::vector<float> rows(6 * count);
    std::ifstream file(argv[1], std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(float)))) {
      throw std::runtime_error("cannot read the points");
    }
    const spincat::OrientedPoints surface = first_rows(rows, count);
    const spincat::OrientedPoints spin_points = first_rows(rows, keypoints);
    spincat::SpinImageParams params;
    params.image_width = 20;
    params.bin_size = 0.05;
    for (int i = 0; i < std::atoi(argv[4]); ++i) {
      const auto begin = std::chrono::steady_clock::now();
      const spincat::SpinImages images = spincat::make_spin_images(surface, spin_points, params, std::atoi(argv[5]));
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
      std::printf("%.4f\n", took.count());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spincat_python_overhead: %s\n", error.what());
    return 1;
  }
}
