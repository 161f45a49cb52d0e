// A data set as a folder with a sub-folder for each category.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "spincat/dataset/listing.h"
#include "spincat/error.h"
#include "spincat/io/read_object.h"
#include "spincat/io/unread_format.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExpected =
    "expected a sub-folder for each category, with .off, .obj, ... files, or train and test folders of such";

struct Entry {
  fs::path path;
  bool is_folder = false;
};

[[noreturn]] void fail_to_read(const fs::path& path, const std::error_code& error) {
  throw InputError(path.string(), "cannot be read: " + error.message());
}

// Symbolic links are followed; one that leads nowhere or in a circle is no folder.
bool is_readable_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status) && error != std::errc::too_many_symbolic_link_levels) {
    fail_to_read(path, error);
  }
  return fs::is_directory(status);
}

// What a folder holds, but for names that start with a dot, in byte order: file systems list in any order.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code error;
  fs::directory_iterator next(folder, error);
  while (!error && next != fs::directory_iterator()) {
    const fs::path path = next->path();
    if (!path.filename().native().starts_with('.')) {
      entries.push_back({path, is_readable_folder(path)});
    }
    next.increment(error);
  }
  if (error) {
    fail_to_read(folder, error);
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.path.native() < b.path.native(); });
  return entries;
}

bool is_split_name(const fs::path& name) {
  constexpr std::array<std::string_view, 4> kNames = {"train", "test", "val", "validation"};
  return std::find(kNames.begin(), kNames.end(), name.native()) != kNames.end();
}

class FolderLister {
 public:
  explicit FolderLister(const fs::path& folder) : root_(folder) { listing_.source = folder; }

  Listing list() {
    std::size_t strays = 0;
    for (const Entry& entry : entries_of(root_)) {
      if (!entry.is_folder) {
        strays += skip_stray(entry.path) ? 1 : 0;
      } else if (is_split_name(entry.path.filename())) {
        strays += list_split(entry.path);
      } else {
        list_category(entry.path, "");
      }
    }
    if (listing_.objects.empty()) {
      std::string found = strays == 0 ? "" : fmt::format("; objects outside such sub-folders: {}", strays);
      found += unread_.empty() ? "" : "; " + unread_.text();
      throw InputError(root_.string(), fmt::format("holds no objects ({}{})", kExpected, found));
    }
    if (!unread_.empty()) {
      listing_.skipped.push_back({root_, "holds " + unread_.text()});
    }
    return std::move(listing_);
  }

 private:
  // The number of objects that belong to no category.
  std::size_t list_split(const fs::path& folder) {
    std::size_t strays = 0;
    for (const Entry& entry : entries_of(folder)) {
      if (entry.is_folder) {
        list_category(entry.path, folder.filename().string());
      } else {
        strays += skip_stray(entry.path) ? 1 : 0;
      }
    }
    return strays;
  }

  bool skip_stray(const fs::path& file) {
    const bool is_object = is_object_file(file);
    if (is_object) {
      listing_.skipped.push_back({file, "lies in no category's sub-folder"});
    } else {
      unread_.look_at(file);
    }
    return is_object;
  }

  void list_category(const fs::path& folder, const std::string& split) {
    // A folder is entered once for each category, so that links that lead in a circle come to an end.
    entered_.clear();
    enter(root_);
    enter(folder.parent_path());
    const std::size_t objects_before = listing_.objects.size();
    const std::uint32_t listed_class = class_called(folder.filename().string());
    list_objects(folder, listed_class, split, split.empty());
    if (listing_.objects.size() == objects_before) {
      listing_.skipped.push_back({folder, "holds no object files"});
    }
  }

  void list_objects(const fs::path& folder, std::uint32_t listed_class, const std::string& split, bool may_split) {
    if (!enter(folder)) {
      return;
    }
    for (const Entry& entry : entries_of(folder)) {
      const fs::path name = entry.path.filename();
      if (entry.is_folder) {
        list_objects(entry.path, listed_class, may_split && is_split_name(name) ? name.string() : split, false);
      } else if (is_object_file(entry.path)) {
        listing_.objects.push_back({entry.path, listed_class, split});
      } else {
        unread_.look_at(entry.path);
      }
    }
  }

  bool enter(const fs::path& folder) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error) {
      fail_to_read(folder, error);
    }
    return entered_.insert(real).second;
  }

  std::uint32_t class_called(const std::string& name) {
    const auto next_class = static_cast<std::uint32_t>(listing_.classes.size());
    const auto [found, is_new] = class_of_name_.emplace(name, next_class);
    if (is_new) {
      listing_.classes.push_back({name, std::nullopt});
    }
    return found->second;
  }

  fs::path root_;
  Listing listing_;
  UnreadFiles unread_;
  std::unordered_map<std::string, std::uint32_t> class_of_name_;
  std::set<fs::path> entered_;
};

}  // namespace

Listing list_folder(const fs::path& folder) {
  return FolderLister(folder).list();
}

}  // namespace spincat
