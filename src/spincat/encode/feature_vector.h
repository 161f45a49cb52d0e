// What the judges see of an object.
#pragma once

#include <string>
#include <vector>

namespace spincat {

struct FeatureVector {
  std::vector<float> values;  // D numbers, all finite
  std::string encoding;       // the encoding that made it, as in Encoding::name
};

}  // namespace spincat
