// Parts of data sets: what is learned from, what is tested, which categories take part.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/dataset/splits.h"

namespace spincat {

// Without the categories of fewer than `fewest` objects, which are added to `left_out`. The same when none is.
Dataset with_enough_objects(const Dataset& dataset, int fewest, std::vector<LeftOutCategory>& left_out);

// Both data sets with only the categories that they share by name, in the same order; the others are added to
// `left_out`, with the data set they are missing from. Throws InputError when they share fewer than two, or when a file
// is in both.
std::pair<Dataset, Dataset> common_categories(const Dataset& train, const Dataset& test,
                                              std::vector<LeftOutCategory>& left_out);

// A checksum of the list of files with their categories, for telling whether two runs saw the same data set: eight
// hexadecimal digits (CRC-32). Files count by their paths below the deepest folder that holds them all, so that it does
// not matter where the data set lies; what is in the files does not count.
std::string list_checksum(const std::vector<DatasetObject>& objects, const std::vector<std::string>& categories);

}  // namespace spincat
