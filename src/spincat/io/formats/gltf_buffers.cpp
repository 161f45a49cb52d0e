#include "spincat/io/formats/gltf_buffers.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/system_error_text.h"
#include "spincat/io/formats/data_uri.h"
#include "spincat/io/formats/gltf_json.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using nlohmann::json;

std::filesystem::path path_beside(const std::filesystem::path& folder, const std::string& uri) {
  const std::filesystem::path relative = std::filesystem::path(decode_percent(uri)).lexically_normal();
  const bool outside = relative.is_absolute() || relative.empty() || *relative.begin() == "..";
  if (outside || relative.native().find('\0') != std::string::npos) {
    throw InputError(fmt::format("its buffer {} does not lie in the file's own folder", in_quotes(uri)));
  }
  return folder / relative;
}

struct stat status_beside(const std::filesystem::path& folder, const std::string& uri) {
  struct stat status = {};
  if (::stat(path_beside(folder, uri).c_str(), &status) != 0) {
    throw InputError(fmt::format("its buffer {}: {}", in_quotes(uri), system_error_text(errno)));
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(fmt::format("its buffer {} is no regular file", in_quotes(uri)));
  }
  return status;
}

std::string read_beside(const std::filesystem::path& folder, const std::string& uri, std::uint64_t length) {
  try {
    return read_file(path_beside(folder, uri), length);
  } catch (const InputError& unread) {
    throw InputError(fmt::format("its buffer {}: {}", in_quotes(uri), unread.problem()));
  }
}

std::string read_data_uri(const std::string& uri, std::size_t number, std::uint64_t length) {
  try {
    std::string bytes = decode_data_uri(uri);
    if (bytes.size() > length) {
      bytes.resize(length);
    }
    return bytes;
  } catch (const InputError& wrong) {
    throw InputError(fmt::format("its buffer {} {}", number, wrong.problem()));
  }
}

std::uint64_t length_of(const json& buffer, std::size_t number) {
  const std::optional<std::uint64_t> length = number_of(buffer, "byteLength");
  if (!length) {
    throw InputError(fmt::format("its buffer {} has no byteLength", number));
  }
  return *length;
}

void check_whole(std::size_t number, std::uint64_t size, std::uint64_t length) {
  if (size < length) {
    throw InputError(fmt::format("its buffer {} is cut off: {} of {} bytes", number, size, length));
  }
}

bool is_fallback(const json& buffer) {
  const json* compression = meshopt_extension(buffer);
  const json* fallback = compression != nullptr ? member(*compression, "fallback") : nullptr;
  return fallback != nullptr && fallback->is_boolean() && fallback->get<bool>();
}

}  // namespace

GltfBuffers::GltfBuffers(json& document, std::optional<std::string_view> binary, std::filesystem::path folder)
    : document_(document), binary_(binary), folder_(std::move(folder)) {
  unpacked_into_.resize(array_size(document, "buffers"));
  for (std::size_t i = 0; i < array_size(document, "bufferViews"); ++i) {
    const json& view = document["bufferViews"][i];
    const std::optional<std::uint64_t> buffer = number_of(view, "buffer");
    if (meshopt_extension(view) != nullptr && buffer && *buffer < unpacked_into_.size()) {
      unpacked_into_[*buffer] = true;
    }
  }
}

bool GltfBuffers::is_room(std::size_t number) const {
  const json& buffer = document_["buffers"][number];
  const bool has_bytes = text_of(buffer, "uri") != nullptr || (number == 0 && binary_);
  return unpacked_into_[number] && (!has_bytes || is_fallback(buffer));
}

BufferSizes GltfBuffers::measure() const {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60;  // beyond all memory; sums stay below the largest number
  BufferSizes sizes;
  std::map<std::pair<dev_t, ino_t>, std::uint64_t> read_of_file;  // by which it is known under all its names
  for (std::size_t i = 0; i < unpacked_into_.size(); ++i) {
    const json& buffer = document_["buffers"][i];
    std::uint64_t length = length_of(buffer, i);
    const std::string* uri = text_of(buffer, "uri");
    if (is_room(i)) {
      // Nothing is read.
    } else if (uri != nullptr && is_data_uri(*uri)) {
      length = std::min<std::uint64_t>(length, uri->size());
    } else if (uri != nullptr) {
      const struct stat status = status_beside(folder_, *uri);
      check_whole(i, static_cast<std::uint64_t>(status.st_size), length);
      std::uint64_t& read = read_of_file[{status.st_dev, status.st_ino}];
      const std::uint64_t before = std::exchange(read, std::max(read, length));
      sizes.files = std::min(kMost, sizes.files + read - before);
    } else {
      check_whole(i, i == 0 && binary_ ? binary_->size() : 0, length);
    }
    sizes.memory = std::min(kMost, sizes.memory + length);
    sizes.largest = std::min(kMost, std::max(sizes.largest, length));
  }
  return sizes;
}

std::vector<std::string> GltfBuffers::collect() {
  std::vector<std::string> buffers(unpacked_into_.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    json& buffer = document_["buffers"][i];
    const std::uint64_t length = length_of(buffer, i);
    const std::string* uri = text_of(buffer, "uri");
    if (is_room(i)) {
      buffers[i].resize(length);
    } else if (uri != nullptr && is_data_uri(*uri)) {
      buffers[i] = read_data_uri(*uri, i, length);
    } else if (uri != nullptr) {
      buffers[i] = read_beside(folder_, *uri, length);
    } else if (binary_) {
      buffers[i] = binary_->substr(0, length);
    }
    check_whole(i, buffers[i].size(), length);  // files may have changed
    buffer["uri"] = std::to_string(i);
  }
  return buffers;
}

std::optional<std::string_view> view_bytes(const json& view, const std::vector<std::string>& buffers) {
  const std::optional<std::uint64_t> number = number_of(view, "buffer");
  const std::optional<std::uint64_t> length = number_of(view, "byteLength");
  const std::uint64_t offset = number_of(view, "byteOffset").value_or(0);
  if (!number || !length || *number >= buffers.size()) {
    return std::nullopt;
  }
  const std::string_view all = buffers[*number];
  if (offset > all.size() || *length > all.size() - offset) {
    return std::nullopt;
  }
  return all.substr(offset, *length);
}

}  // namespace spincat::io
