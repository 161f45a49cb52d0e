// A data set listed by a CSV file: path,category[,split].
#include <unordered_map>

#include "spincat/dataset/csv_reader.h"
#include "spincat/dataset/listing.h"

namespace spincat {

Listing list_csv(const std::filesystem::path& file, const std::filesystem::path& models) {
  const CsvTable table = read_csv_table(file);
  const std::size_t path = table.column("path");
  const std::size_t category = table.column("category");
  const auto split = table.find_column("split");
  const std::filesystem::path folder = models.empty() ? file.parent_path() : models;

  Listing listing{.source = file, .classes = {}, .objects = {}, .skipped = {}};
  std::unordered_map<std::string, std::uint32_t> class_of_name;
  for (const CsvRow& row : table.rows) {
    const std::string& name = table.filled(row, category);
    const auto next_class = static_cast<std::uint32_t>(listing.classes.size());
    const auto [found, is_new] = class_of_name.emplace(name, next_class);
    if (is_new) {
      listing.classes.push_back({name, std::nullopt});
    }
    listing.objects.push_back({folder / table.filled(row, path), found->second, split ? row.fields[*split] : ""});
  }
  return listing;
}

}  // namespace spincat
