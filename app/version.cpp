#include "app/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "app/camera/freenect_source.h"
#include "app/ranks/ranks.h"
#include "spincat/classify/model.h"
#include "spincat/io/read_object.h"
#include "spincat/report/text_table.h"
#include "spincat/spin/kernel.h"
#include "spincat/version.h"

namespace spincat::app {
namespace {

std::string compiler() {
#ifdef __clang__
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

constexpr bool has_draco() {
#ifdef SPINCAT_DRACO
  return true;
#else
  return false;
#endif
}

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string version_text() {
  const std::string_view path = spin_kernel().name;
  TextTable table({Align::left, Align::left});
  table.add({"built with", fmt::format("{}, {}", compiler(), SPINCAT_BUILD_TYPE)});
  table.add({"spin images", fmt::format("{} (this machine: {})", path, listed(simd_paths()))});
  table.add({"MPI", listed(mpi_plugins())});
  table.add({"Kinect", has_kinect() ? "yes" : "no"});
  table.add({"reads", fmt::format("{}{}", listed(object_extensions()), has_draco() ? ", Draco in glTF" : "")});
  table.add({"models", fmt::format("version {}", kModelVersion)});
  std::string text = std::string(kProgram) + "\n" + table.str();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

}  // namespace spincat::app
