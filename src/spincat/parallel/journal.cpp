#include "spincat/parallel/journal.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/paths.h"
#include "spincat/parallel/packing.h"

namespace spincat {
namespace {

// The layout: magic, settings, data, checksum of these; then for each task job, number, length, result, checksum.
constexpr std::string_view kMagic = "SPINCAT-JOURNAL\x01";
constexpr std::size_t kRecordHead = 3 * sizeof(std::uint64_t);
constexpr std::size_t kChecksum = sizeof(std::uint32_t);

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string with_checksum(std::string bytes) {
  const std::uint32_t checksum = checksum_of(bytes);
  bytes.append(reinterpret_cast<const char*>(&checksum), kChecksum);
  return bytes;
}

bool checks(std::string_view bytes) {
  std::uint32_t stored = 0;
  std::memcpy(&stored, bytes.data() + bytes.size() - kChecksum, kChecksum);
  return stored == checksum_of(bytes.substr(0, bytes.size() - kChecksum));
}

std::string head_of(const RunIdentity& identity) {
  return with_checksum(Packer().add(kMagic).add(identity.settings).add(identity.data).take());
}

}  // namespace

Journal::Journal(std::filesystem::path file, const RunIdentity& identity) : file_(std::move(file)) {
  begin(identity);
}

// Checks the head of a journal that is there, or writes that of a new one.
void Journal::begin(const RunIdentity& identity) {
  const std::string head = head_of(identity);
  const std::uint64_t size = file_.size();
  const std::optional<std::string> begun = file_.read(0, std::min<std::uint64_t>(size, head.size()));
  if (!begun) {
    throw RunError(file_.name().string(), "cannot be read: it has become shorter");
  }
  const std::string& there = *begun;
  if (there == head) {
    read_records(head.size(), size);
    return;
  }
  if (size >= head.size() || (size > 0 && head.compare(0, there.size(), there) != 0)) {
    const std::string magic = Packer().add(kMagic).take();
    const std::string settings = Packer().add(kMagic).add(identity.settings).take();
    if (there.compare(0, magic.size(), magic) != 0) {
      throw InputError(file_.name().string(), "is no journal of spincat");
    }
    throw InputError(file_.name().string(),
                     fmt::format("is the journal of a run with other {}; give the same command as then, remove it, or "
                                 "name another one by --journal",
                                 there.compare(0, settings.size(), settings) != 0 ? "settings" : "data"));
  }
  file_.cut(0);
  file_.write(0, head);
  end_ = head.size();
}

void Journal::read_records(std::uint64_t offset, std::uint64_t file_size) {
  while (offset + kRecordHead + kChecksum <= file_size) {
    const std::string head = file_.read(offset, kRecordHead).value_or("");
    if (head.size() < kRecordHead) {
      break;
    }
    Unpacker fields(head);
    const auto job = fields.get<std::uint64_t>();
    const auto task = fields.get<std::uint64_t>();
    const auto length = fields.get<std::uint64_t>();
    if (length > file_size - offset - kRecordHead - kChecksum) {
      break;
    }
    const auto whole = file_.read(offset, kRecordHead + length + kChecksum);
    if (!whole || !checks(*whole)) {
      break;
    }
    records_[{job, task}] = {offset + kRecordHead, length};
    offset += whole->size();
  }
  end_ = offset;
  file_.cut(end_);
}

std::optional<std::string> Journal::find(std::uint64_t job, std::uint64_t task) const {
  const auto found = records_.find({job, task});
  return found == records_.end() ? std::nullopt : file_.read(found->second.offset, found->second.length);
}

void Journal::add(std::uint64_t job, std::uint64_t task, std::string_view result) {
  const std::string record = with_checksum(Packer().add(job).add(task).add(result).take());
  file_.write(end_, record);
  records_[{job, task}] = {end_ + kRecordHead, result.size()};
  end_ += record.size();
}

std::uint64_t hash_of(std::string_view bytes, std::uint64_t before) {
  std::uint64_t hash = before ^ 0xcbf29ce484222325U;
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

std::uint64_t job_key(std::uint64_t place, std::string_view kind, std::uint64_t tasks, std::uint64_t content) {
  return hash_of(fmt::format("|{}|{}|{:x}", place, tasks, content), hash_of(kind));
}

void FilesIdentity::add(const std::filesystem::path& file) {
  add_one(file);
  ++files_;
  const std::string extension = lower_extension(file);
  if (extension == ".gltf" || extension == ".glb") {
    add_buffers(file.parent_path());
  }
}

void FilesIdentity::add_buffers(const std::filesystem::path& folder) {
  if (!folders_of_buffers_.insert(folder).second) {
    return;
  }
  std::set<std::filesystem::path> buffers;  // in an order of their own, not of the folder
  std::error_code error;
  std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string extension = lower_extension(entry->path());
    if (extension == ".bin" || extension == ".glbin" || extension == ".glbuf") {
      buffers.insert(entry->path());
    }
  }
  for (const std::filesystem::path& buffer : buffers) {
    add_one(buffer);
  }
}

void FilesIdentity::add_one(const std::filesystem::path& file) {
  struct stat status = {};
  hash_ = hash_of(file.string(), hash_);
  if (::stat(file.c_str(), &status) == 0) {
    hash_ = hash_of(fmt::format("|{}|{}.{}\n", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec), hash_);
  }
}

std::string FilesIdentity::text() const {
  return fmt::format("{} files, {:016x}", files_, hash_);
}

}  // namespace spincat
