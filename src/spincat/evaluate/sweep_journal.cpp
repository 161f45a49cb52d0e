#include "spincat/evaluate/sweep_journal.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "spincat/error.h"

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

std::string as_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// A blank and eight digits.
std::string checksum_of(std::string_view text) {
  return fmt::format(" {:08x}", crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

constexpr std::size_t kChecksum = 9;

std::string_view without_checksum(std::string_view line) {
  return line.substr(0, line.size() - std::min(line.size(), kChecksum));
}

bool checks(std::string_view line) {
  const std::string_view text = without_checksum(line);
  return line.substr(text.size()) == checksum_of(text);
}

std::string as_line(const Json& json) {
  const std::string text = as_text(json);
  return text + checksum_of(text) + "\n";
}

// The first line of a journal, as far as its text tells.
bool begins_journal(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.contains("sweep");
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

SweepJournal::SweepJournal(const std::filesystem::path& file, const Json& identity) {
  if (file.empty()) {
    return;
  }
  file_.emplace(file);
  const std::optional<std::string> text = file_->read(0, file_->size());
  if (!text) {
    throw RunError(file.string(), "cannot be read: it has become shorter");
  }
  read(*text, identity);
  if (whole_ == 0) {
    append(as_line(identity));
  }
}

void SweepJournal::read(const std::string& text, const Json& identity) {
  const std::string file = file_->name().string();
  std::size_t line = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', whole_)) {
    ++line;
    if (end - whole_ > kLongestLine) {
      throw InputError(file, fmt::format("line {} is longer than any of a sweep", line));
    }
    const std::string_view whole_line = std::string_view(text).substr(whole_, end - whole_);
    const std::string_view content = without_checksum(whole_line);
    if (whole_ == 0 && begins_journal(whole_line)) {
      throw InputError(file, "is the journal of an older spincat: remove it, or name another file");
    }
    if (whole_ == 0 && !begins_journal(content)) {
      throw InputError(file, "is no journal of a sweep");
    }
    if (!checks(whole_line)) {
      throw InputError(file, fmt::format("line {} is damaged (its checksum is not right): remove the file, or name "
                                         "another one",
                                         line));
    }
    const Json json = Json::parse(content, nullptr, false);
    if (whole_ == 0) {
      // As text: what was read has passed through it once.
      if (const Json ours = Json::parse(as_text(identity)); json != ours) {
        throw InputError(file, fmt::format("is the journal of another sweep ({} differs): remove it, or name "
                                           "another file",
                                           difference(json, ours)));
      }
    } else {
      try {
        SweepPoint point = point_of(json);
        if (point.values.size() > kMostValues) {
          throw InputError(file, fmt::format("line {} is no point of a sweep", line));
        }
        points_[point.values] = point;
      } catch (const Json::exception&) {
        throw InputError(file, fmt::format("line {} is no point of a sweep", line));
      }
    }
    whole_ = end + 1;
  }
  if (whole_ == 0 && !as_line(identity).starts_with(text)) {
    throw InputError(file, "is no journal of a sweep");
  }
}

const SweepPoint* SweepJournal::find(const std::vector<std::string>& values) const {
  const auto at = points_.find(values);
  return at == points_.end() ? nullptr : &at->second;
}

void SweepJournal::add(const SweepPoint& point) {
  if (file_) {
    append(as_line(point_json(point)));
  }
  points_[point.values] = point;
}

void SweepJournal::append(const std::string& line) {
  file_->cut(whole_);
  file_->write(whole_, line);
  file_->flush();
  whole_ += line.size();
}

}  // namespace spincat
