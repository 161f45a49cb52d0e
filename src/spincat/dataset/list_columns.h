// The columns of a list of objects, and what stands in them. Private to dataset.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

#include "spincat/dataset/csv_reader.h"

namespace spincat {

// By the names that lists in use have for them. The first two throw InputError when there is none.
std::size_t path_column(const CsvTable& table);
std::size_t category_column(const CsvTable& table);
std::optional<std::size_t> split_column(const CsvTable& table);

// The file that a list calls `name`, relative to a folder. Backslashes part folders where a file is found so, and none
// of the name as it stands.
std::filesystem::path listed_file(const std::filesystem::path& folder, std::string_view name);

}  // namespace spincat
