// A data set listed by a CSV file: path,category[,split].
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_map>

#include "spincat/dataset/csv_reader.h"
#include "spincat/dataset/listing.h"
#include "spincat/dataset/words.h"
#include "spincat/error.h"

namespace spincat {
namespace {

// A misspelt "Train" must not quietly hold objects back from training.
std::string checked_split(const std::filesystem::path& file, const CsvRow& row, std::size_t column) {
  const std::string& split = row.fields[column];
  for (const std::string_view known : {"", "train", "test", "val", "validation"}) {
    if (split == known) {
      return split;
    }
  }
  throw InputError(file.string(), at_line(row.line, fmt::format("split {} is not known (train, test, val, validation)",
                                                                in_quotes(split))));
}

}  // namespace

Listing list_csv(const std::filesystem::path& file, const std::filesystem::path& models, const ReadLimits& limits) {
  CsvTable table(file);
  const std::size_t path = path_column(table);
  const std::size_t category = category_column(table);
  const auto split = split_column(table);
  const std::filesystem::path folder = models.empty() ? file.parent_path() : models;

  ListBuilder list(file, table.file_size(), limits);
  std::unordered_map<std::string, std::uint32_t> class_of_name;
  while (const auto row = table.next()) {
    const std::string& name = table.filled(*row, category);
    const auto [found, is_new] = class_of_name.emplace(name, list.classes());
    if (is_new) {
      list.add_class({name, std::nullopt});
    }
    list.add_object(
        {listed_file(folder, table.filled(*row, path)), found->second, split ? checked_split(file, *row, *split) : ""});
  }
  return list.take();
}

}  // namespace spincat
