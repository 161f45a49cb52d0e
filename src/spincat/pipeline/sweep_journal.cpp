#include "spincat/pipeline/sweep_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "spincat/error.h"
#include "spincat/io/file.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

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
  std::error_code error;
  if (std::filesystem::exists(file_, error)) {
    read(read_file(file_), identity);
  }
  if (whole_ == 0) {
    append(identity.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
}

void SweepJournal::read(const std::string& text, const Json& identity) {
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', whole_)) {
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
        points_[point.values] = point;
      } catch (const Json::exception&) {
        throw InputError(file_.string(), fmt::format("line {} is no point of a sweep", points_.size() + 2));
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
  const int descriptor = open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  bool good =
      descriptor >= 0 && ftruncate(descriptor, static_cast<off_t>(whole_)) == 0 &&
      pwrite(descriptor, line.data(), line.size(), static_cast<off_t>(whole_)) == static_cast<ssize_t>(line.size()) &&
      fsync(descriptor) == 0;
  const int reason = errno;
  good = (descriptor < 0 || close(descriptor) == 0) && good;
  if (!good) {
    throw RunError(file_.string(), fmt::format("cannot write: {}", std::strerror(reason)));
  }
  whole_ += line.size();
}

}  // namespace spincat
