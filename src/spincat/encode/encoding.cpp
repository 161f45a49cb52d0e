#include "spincat/encode/encoding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spincat/error.h"

namespace spincat {

std::unique_ptr<Encoding> make_encoding(std::string_view name) {
  if (name == "pooled-pyramid") {
    return make_pooled_pyramid();
  }
  if (name == "concatenation") {
    return make_concatenation();
  }
  if (name == "mean-image") {
    return make_mean_image();
  }
  if (name == "bag-of-features") {
    return make_bag_of_features();
  }
  throw InputError(fmt::format("encoding '{}' is not known (one of {})", name, fmt::join(encoding_names(), ", ")));
}

const std::vector<std::string>& encoding_names() {
  static const std::vector<std::string> names = {"pooled-pyramid", "concatenation", "mean-image", "bag-of-features"};
  return names;
}

}  // namespace spincat
