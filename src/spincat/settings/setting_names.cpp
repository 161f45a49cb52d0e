#include "spincat/settings/setting_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "spincat/error.h"

namespace spincat {
namespace {

constexpr ChoiceName<SurfaceKind> kSurfaceKinds[] = {
    {SurfaceKind::vertices, "vertices"}, {SurfaceKind::samples, "samples"}, {SurfaceKind::external, "external"}};
constexpr ChoiceName<NormalOrientation> kOrientations[] = {{NormalOrientation::as_given, "as-given"},
                                                           {NormalOrientation::outward, "outward"}};
constexpr ChoiceName<SpinConvention> kConventions[] = {{SpinConvention::johnson, "johnson"},
                                                       {SpinConvention::pcl, "pcl"}};
constexpr ChoiceName<Binning> kBinnings[] = {{Binning::bilinear, "bilinear"}, {Binning::nearest, "nearest"}};
constexpr ChoiceName<AngleTest> kAngleTests[] = {{AngleTest::cutoff, "cutoff"}, {AngleTest::soft, "soft"}};
constexpr ChoiceName<BinSizeUnit> kUnits[] = {
    {BinSizeUnit::absolute, "absolute"}, {BinSizeUnit::resolution, "resolution"}, {BinSizeUnit::relative, "relative"}};
constexpr ChoiceName<KernelKind> kKernels[] = {{KernelKind::linear, "linear"}, {KernelKind::rbf, "rbf"}};
constexpr ChoiceName<UpAxis> kUpAxes[] = {{UpAxis::none, "none"}, {UpAxis::x, "x"}, {UpAxis::y, "y"}, {UpAxis::z, "z"}};
constexpr ChoiceName<TrainedFor> kTrainedFor[] = {
    {TrainedFor::meshes, "meshes"}, {TrainedFor::any, "any"}, {TrainedFor::views, "views"}};

}  // namespace

template <>
std::span<const ChoiceName<SurfaceKind>> choices() {
  return kSurfaceKinds;
}
template <>
std::span<const ChoiceName<NormalOrientation>> choices() {
  return kOrientations;
}
template <>
std::span<const ChoiceName<SpinConvention>> choices() {
  return kConventions;
}
template <>
std::span<const ChoiceName<Binning>> choices() {
  return kBinnings;
}
template <>
std::span<const ChoiceName<AngleTest>> choices() {
  return kAngleTests;
}
template <>
std::span<const ChoiceName<BinSizeUnit>> choices() {
  return kUnits;
}
template <>
std::span<const ChoiceName<KernelKind>> choices() {
  return kKernels;
}
template <>
std::span<const ChoiceName<UpAxis>> choices() {
  return kUpAxes;
}
template <>
std::span<const ChoiceName<TrainedFor>> choices() {
  return kTrainedFor;
}

bool is_setting_text(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  return text.size() <= kLongest && std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

void throw_unknown_choice(std::string_view field, std::string_view name, std::span<const std::string_view> known) {
  throw InputError(fmt::format("{} '{}' is not known (one of {})", field, name, fmt::join(known, ", ")));
}

}  // namespace spincat
