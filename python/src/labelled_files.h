// A data set that Python's lists name.
#pragma once

#include <spincat/spincat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spincat::python {

// A label for each file: its index in `categories`, which are sorted.
inline Dataset labelled_files(const std::vector<std::filesystem::path>& files, const std::vector<std::uint32_t>& labels,
                              const std::vector<std::string>& categories, const std::string& name) {
  Dataset dataset;
  dataset.name = name;
  dataset.categories = categories;
  for (std::size_t i = 0; i < files.size(); ++i) {
    dataset.objects.push_back({files[i], labels.at(i), {}});
  }
  return dataset;
}

}  // namespace spincat::python
