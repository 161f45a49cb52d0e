// A file of finished tasks: an interrupted run goes on where it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "spincat/files/locked_file.h"

namespace spincat {

// Which run a journal belongs to. Results are only good for the same program, command, settings and data.
struct RunIdentity {
  std::string settings;  // whatever decides about results
  std::string data;      // names, sizes and times of the files worked on
};

// Append-only. Every record has a checksum; what a killed run left unfinished at the end is cut off. Tasks are known by
// their job (job_key) and their number in it.
class Journal {
 public:
  // Opens the journal at `file` or begins one. Throws InputError when the file is no journal or belongs to a run with
  // other settings or data, RunError when it cannot be written or another run is using it.
  Journal(std::filesystem::path file, const RunIdentity& identity);

  const std::filesystem::path& file() const { return file_.name(); }
  std::size_t size() const { return records_.size(); }  // finished tasks
  bool has(std::uint64_t job, std::uint64_t task) const { return records_.contains({job, task}); }
  std::optional<std::string> find(std::uint64_t job, std::uint64_t task) const;

  // Keeps the result of a task. Throws RunError when it cannot be written.
  void add(std::uint64_t job, std::uint64_t task, std::string_view result);

  // Removes the file: the run is complete.
  void remove() { file_.remove(); }

 private:
  struct Place {
    std::uint64_t offset;
    std::uint64_t length;
  };

  void begin(const RunIdentity& identity);
  void read_records(std::uint64_t offset, std::uint64_t file_size);

  LockedFile file_;
  std::uint64_t end_ = 0;  // of the last whole record
  std::map<std::pair<std::uint64_t, std::uint64_t>, Place> records_;
};

// FNV-1a, from where another text ended.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t before = 0);

// How a journal knows a job of a run: by its place in it, what it does, into how many tasks it was cut, and the hash of
// all that its results depend on. A run with another number of ranks may cut otherwise, and then does not find these
// tasks.
std::uint64_t job_key(std::uint64_t place, std::string_view kind, std::uint64_t tasks, std::uint64_t content);

// Names, sizes and times of last change of files, as one short text for RunIdentity::data. Files that are not there
// count as such. With a .gltf or .glb file count the files of buffers that lie beside it (.bin, .glbin, .glbuf): it may
// name any of them.
class FilesIdentity {
 public:
  void add(const std::filesystem::path& file);
  std::string text() const;

 private:
  void add_one(const std::filesystem::path& file);
  void add_buffers(const std::filesystem::path& folder);

  std::uint64_t hash_ = 0;
  std::set<std::filesystem::path> folders_of_buffers_;  // that were added
  std::size_t files_ = 0;
};

}  // namespace spincat
