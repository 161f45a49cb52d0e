// All SIMD code of the engine. This file is compiled once for each instruction set (Highway's foreach_target includes
// it again and again), and the best one that the machine has is chosen at run time.
//
// Every path computes the same bytes: places are computed by the same single-precision operations in the same order (no
// fused multiply-add), and sums are integers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spincat/spin/kernel.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "spincat/spin/kernel.h"
#include "spincat/spin/kernel_groups-inl.h"
#include "spincat/spin/kernel_image-inl.h"
#include "spincat/spin/kernel_sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {

SpinKernel kernel() {
  return {"", select_tiles, accumulate, finish};
}

}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdlib>

#include "spincat/error.h"

namespace spincat {
namespace {

HWY_EXPORT(kernel);

struct Path {
  std::string name;
  SpinKernel kernel;
};

std::string path_name(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  for (char& c : name) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name.starts_with("avx3")) {
    return "avx512";
  }
  return name.starts_with("emu") || name == "scalar" ? "portable" : name;
}

// All paths that were compiled and that this machine can run, the fastest first: Highway numbers the better targets
// lower.
std::vector<Path> find_paths() {
  std::vector<Path> paths;
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t left = usable; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    // Newer versions of Highway have several for AVX-512, one after the other.
    if (paths.empty() || paths.back().name != path_name(target)) {
      paths.push_back({path_name(target), HWY_DYNAMIC_DISPATCH(kernel)()});
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  for (Path& path : paths) {
    path.kernel.name = path.name;
  }
  return paths;
}

const std::vector<Path>& paths() {
  static const std::vector<Path> all = find_paths();
  return all;
}

}  // namespace

CellLayout::CellLayout(const Support& support)
    : row_stride((support.cell_columns + 7) / 8 * 8), plane_stride(support.cell_rows * row_stride), size(0) {
  const std::size_t numbers = support.binning == Binning::bilinear ? 4 : 1;
  plane_stride *= numbers;
  size = plane_stride * (support.soft ? 2 : 1);
}

const std::vector<std::string>& simd_paths() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Path& path : paths()) {
      all.push_back(path.name);
    }
    return all;
  }();
  return names;
}

const SpinKernel& spin_kernel() {
  const char* wanted = std::getenv("SPINCAT_SIMD");
  if (wanted == nullptr || *wanted == '\0') {
    return paths().front().kernel;
  }
  for (const Path& path : paths()) {
    if (path.name == wanted) {
      return path.kernel;
    }
  }
  throw InputError(
      fmt::format("SPINCAT_SIMD names the path '{}', which is not known or which this machine cannot run "
                  "(one of {})",
                  wanted, fmt::join(simd_paths(), ", ")));
}

}  // namespace spincat
#endif
