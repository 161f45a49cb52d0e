#include "spincat/pipeline/sweep_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "spincat/error.h"
#include "spincat/io/file.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

// Far more than a sweep ever writes; JSON takes up to 80 times its text in memory.
constexpr std::size_t kLongestLine = 100'000;
constexpr std::size_t kMostValues = 16;  // of a point, one for each setting that is varied

Json rate_json(const Rate& rate) {
  return {rate.mean, rate.deviation, rate.interval.low, rate.interval.high};
}

Rate rate_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), {json.at(2).get<double>(), json.at(3).get<double>()}};
}

Json point_json(const SweepPoint& point) {
  const StageSeconds& s = point.seconds;
  return {{"values", point.values},
          {"mean_class_rate", rate_json(point.mean_class_rate)},
          {"overall_rate", rate_json(point.overall_rate)},
          {"seconds", {s.read, s.prepare, s.spin, s.encode, s.judge}}};
}

SweepPoint point_of(const Json& json) {
  const Json& s = json.at("seconds");
  return {json.at("values").get<std::vector<std::string>>(),
          rate_of(json.at("mean_class_rate")),
          rate_of(json.at("overall_rate")),
          {s.at(0).get<double>(), s.at(1).get<double>(), s.at(2).get<double>(), s.at(3).get<double>(),
           s.at(4).get<double>()}};
}

// The first thing in which two sweeps differ.
std::string difference(const Json& theirs, const Json& ours) {
  for (const auto& [key, value] : ours.items()) {
    if (!theirs.contains(key)) {
      return key;
    }
    if (theirs[key] != value) {
      return value.is_object() && theirs[key].is_object() ? difference(theirs[key], value) : key;
    }
  }
  return "its format";
}

}  // namespace

SweepJournal::SweepJournal(std::filesystem::path file, const Json& identity) : file_(std::move(file)) {
  if (file_.empty()) {
    return;
  }
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw RunError(file_.string(), fmt::format("cannot write: {}", std::strerror(errno)));
  }
  try {
    begin(identity);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SweepJournal::~SweepJournal() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

void SweepJournal::begin(const Json& identity) {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw RunError(file_.string(), "is in use by another sweep");
  }
  read(read_file(file_), identity);
  if (whole_ == 0) {
    append(identity.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
}

void SweepJournal::read(const std::string& text, const Json& identity) {
  std::size_t line = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', whole_)) {
    ++line;
    if (end - whole_ > kLongestLine) {
      throw InputError(file_.string(), fmt::format("line {} is longer than any of a sweep", line));
    }
    const Json json = Json::parse(text.substr(whole_, end - whole_), nullptr, false);
    if (whole_ == 0) {
      if (!json.is_object() || !json.contains("sweep")) {
        throw InputError(file_.string(), "is no journal of a sweep");
      }
      // As text: what was read has passed through it once.
      if (const Json ours = Json::parse(identity.dump(-1, ' ', false, Json::error_handler_t::replace)); json != ours) {
        throw InputError(file_.string(), fmt::format("is the journal of another sweep ({} differs): remove it, or name "
                                                     "another file",
                                                     difference(json, ours)));
      }
    } else {
      try {
        SweepPoint point = point_of(json);
        if (point.values.size() > kMostValues) {
          throw InputError(file_.string(), fmt::format("line {} is no point of a sweep", line));
        }
        points_[point.values] = point;
      } catch (const Json::exception&) {
        throw InputError(file_.string(), fmt::format("line {} is no point of a sweep", line));
      }
    }
    whole_ = end + 1;
  }
  if (whole_ == 0 && !text.empty() && text[0] != '{') {
    throw InputError(file_.string(), "is no journal of a sweep");
  }
}

const SweepPoint* SweepJournal::find(const std::vector<std::string>& values) const {
  const auto at = points_.find(values);
  return at == points_.end() ? nullptr : &at->second;
}

void SweepJournal::add(const SweepPoint& point) {
  if (!file_.empty()) {
    append(point_json(point).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  points_[point.values] = point;
}

void SweepJournal::append(const std::string& line) {
  std::string_view rest = line;
  bool good = ftruncate(descriptor_, static_cast<off_t>(whole_)) == 0;
  while (good && !rest.empty()) {
    const ssize_t written =
        pwrite(descriptor_, rest.data(), rest.size(), static_cast<off_t>(whole_ + line.size() - rest.size()));
    good = written >= 0 || errno == EINTR;
    rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  if (!good || fsync(descriptor_) != 0) {
    throw RunError(file_.string(), fmt::format("cannot write: {}", std::strerror(errno)));
  }
  whole_ += line.size();
}

}  // namespace spincat
