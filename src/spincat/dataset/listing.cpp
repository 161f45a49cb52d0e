#include "spincat/dataset/listing.h"

#include "spincat/files/paths.h"

namespace spincat {

ListBuilder::ListBuilder(const std::filesystem::path& source, std::uint64_t file_size, const ReadLimits& limits)
    : listing_{.source = source, .classes = {}, .objects = {}, .skipped = {}}, file_size_(file_size), limits_(limits) {}

// Measured: tests/fuzz/large_test.cpp.
void ListBuilder::add_class(ListedClass listed) {
  constexpr std::uint64_t kBytes = 300;
  add_memory(kBytes + 2 * listed.name.size());
  listing_.classes.push_back(std::move(listed));
}

void ListBuilder::add_object(ListedObject object) {
  constexpr std::uint64_t kBytes = 900;
  add_memory(kBytes + 4 * object.file.native().size());
  listing_.objects.push_back(std::move(object));
}

void ListBuilder::add_memory(std::uint64_t bytes) {
  memory_ += bytes;
  naming_file(listing_.source, [&] { check_growth(memory_, file_size_, limits_); });
}

}  // namespace spincat
