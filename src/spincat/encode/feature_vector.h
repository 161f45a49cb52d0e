// What the judges see of an object.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

struct FeatureVector {
  std::vector<float> values;          // D numbers, all finite
  std::vector<std::uint32_t> blocks;  // how many consecutive numbers belong together; adds up to D, none is 0
  std::string encoding;               // the encoding that made it, as in Encoding::name
  std::uint32_t local_size = 0;       // > 0: local features of so many numbers each, which a codebook has to count
};

}  // namespace spincat
#pragma GCC visibility pop
