#include "spincat/report/camera_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "spincat/report/json_parts.h"
#include "spincat/report/text.h"
#include "spincat/report/text_table.h"

namespace spincat {
namespace {

const char* status_name(FrameStatus status) {
  switch (status) {
    case FrameStatus::objects:
      return "objects";
    case FrameStatus::empty_table:
      return "empty table";
    case FrameStatus::no_table:
      return "no table";
    case FrameStatus::few_readings:
      return "few readings";
    case FrameStatus::wrong_units:
      return "wrong units";
  }
  return "?";
}

double milliseconds(double seconds) {
  return 1e3 * seconds;
}

// No more digits than are meant: the same on every machine.
double rounded(double value, double digits) {
  return std::round(value * digits) / digits;
}

Json vector_json(const Eigen::Vector3f& v) {
  Json json = Json::array();
  for (const float x : v) {
    json.push_back(rounded(static_cast<double>(x), 1e4));
  }
  return json;
}

Json box_json(const OrientedBox& box) {
  Json axes = Json::array();
  for (int k = 0; k < 3; ++k) {
    axes.push_back(vector_json(box.axes.col(k)));
  }
  return {{"centre", vector_json(box.centre)}, {"axes", axes}, {"size", vector_json(box.size)}};
}

Json object_of(const SeenObject& object, const std::vector<std::string>& categories) {
  const Segment& s = object.segment;
  Json json = {{"id", object.id},
               {"box", {s.left, s.top, s.right - s.left + 1, s.bottom - s.top + 1}},
               {"pixels", s.pixels},
               {"centre", vector_json(s.centre)},
               {"box3d", box_json(s.box)},
               {"distance", rounded(static_cast<double>(object.distance), 1e4)},
               {"height", rounded(static_cast<double>(s.height), 1e4)},
               {"cut", s.cut}};
  if (!object.problem.empty()) {
    json["status"] = "not named";
    json["reason"] = object.problem;
    return json;
  }
  json["status"] = object.unknown ? "unknown" : "named";
  json["category"] = categories[object.ballot.winner];
  json["confidence"] = object.confidence;
  json["known"] = object.known;
  json["votes"] = by_category(categories, object.ballot.count);
  json["fused"] = {{"category", object.unknown ? "unknown" : categories[object.fused.winner]},
                   {"confidence", object.fused_confidence},
                   {"known", object.fused_known},
                   {"votes", by_category(categories, object.fused.count)},
                   {"frames", object.fused.ballots}};
  if (object.unknown) {
    json["fused"]["best_guess"] = categories[object.fused.winner];
  }
  return json;
}

Json percentiles(const TimeHistogram& times) {
  return {{"mean", milliseconds(times.mean())},
          {"p50", milliseconds(times.percentile(0.5))},
          {"p95", milliseconds(times.percentile(0.95))},
          {"p99", milliseconds(times.percentile(0.99))},
          {"longest", milliseconds(times.longest())}};
}

std::string object_line(const SeenObject& object, const std::vector<std::string>& categories) {
  const std::string place = fmt::format("{:4}  {:5.2f} m  {:3.0f} cm high", object.id, object.distance,
                                        100.0 * static_cast<double>(object.segment.height));
  const std::string cut = object.segment.cut ? "  (cut by the picture's edge)" : "";
  if (!object.problem.empty()) {
    return place + "  not named: " + object.problem;
  }
  const std::string name = printable(categories[object.fused.winner]);
  return fmt::format("{}  {:<16} {:3.0f} %  {} of {} votes in {} frame{}{}", place,
                     object.unknown ? "unknown (" + name + "?)" : name, 100.0 * object.fused_confidence,
                     object.fused.count[object.fused.winner], object.fused.ballots * (categories.size() - 1),
                     object.fused.ballots, object.fused.ballots == 1 ? "" : "s", cut);
}

std::string times_line(const char* what, const TimeHistogram& times) {
  return fmt::format("{}  p50 {:.1f} ms, p95 {:.1f} ms, p99 {:.1f} ms, longest {:.1f} ms\n", what,
                     milliseconds(times.percentile(0.5)), milliseconds(times.percentile(0.95)),
                     milliseconds(times.percentile(0.99)), milliseconds(times.longest()));
}

}  // namespace

std::string why_nothing(const SeenFrame& frame) {
  const NotObjects& left = frame.segmentation.left_out;
  switch (frame.status) {
    case FrameStatus::objects:
      break;
    case FrameStatus::empty_table:
      return left.outside + left.too_few + left.too_low + left.too_high == 0
                 ? "nothing on the table"
                 : fmt::format(
                       "no object on the table: {} pixels in patches too small, {} too low, {} too high, {} beside the "
                       "table",
                       left.too_few, left.too_low, left.too_high, left.outside);
    case FrameStatus::no_table:
      return "no table: no plane holds enough of the readings (is --up-direction right?)";
    case FrameStatus::few_readings:
      return "hardly a pixel has a depth";
    case FrameStatus::wrong_units:
      if (frame.table) {
        return fmt::format("the plane with most readings is {:.3g} m away, too far for a table: are --units right?",
                           frame.table->offset);
      }
      return fmt::format("readings around {:.3g} m are beyond what depth cameras see: are --units right?",
                         frame.median_depth);
  }
  return {};
}

std::string frame_json(const FrameFacts& facts, const SeenFrame& frame, const std::vector<std::string>& categories) {
  Json json = {{"frame", facts.number},
               {"file", facts.name},
               {"time", facts.time},
               {"size", {facts.width, facts.height}},
               {"status", status_name(frame.status)}};
  if (const std::string reason = why_nothing(frame); !reason.empty()) {
    json["reason"] = reason;
  }
  json["plane"] = nullptr;
  if (frame.table) {
    json["plane"] = {{"normal", vector_json(frame.table->normal)},
                     {"distance", rounded(static_cast<double>(frame.table->offset), 1e4)},
                     {"share", rounded(frame.table->share, 1e4)},
                     {"outline", Json::array()}};
    for (const Eigen::Vector3f& corner : frame.segmentation.outline) {
      json["plane"]["outline"].push_back(vector_json(corner));
    }
  }
  json["objects"] = Json::array();
  for (const SeenObject& object : frame.objects) {
    json["objects"].push_back(object_of(object, categories));
  }
  const NotObjects& left = frame.segmentation.left_out;
  json["left_out"] = {{"too_small", left.too_few},
                      {"too_low", left.too_low},
                      {"too_high", left.too_high},
                      {"beside_table", left.outside}};
  json["milliseconds"] = {{"read", milliseconds(facts.read_seconds)},
                          {"table", milliseconds(frame.seconds.table)},
                          {"segment", milliseconds(frame.seconds.segment)},
                          {"name", milliseconds(frame.seconds.name)}};
  json["dropped"] = facts.dropped;
  return line(json);
}

std::string frame_error_json(std::size_t number, const std::string& error) {
  return line({{"frame", number}, {"error", error}});
}

std::string summary_json(const CameraSummary& s) {
  return line({{"summary",
                {{"frames", s.frames},
                 {"failed", s.failed},
                 {"dropped", s.dropped},
                 {"objects", s.objects},
                 {"gave_up", s.gave_up},
                 {"seconds", s.wall_seconds},
                 {"frames_a_second", s.look.sum() > 0.0 ? static_cast<double>(s.frames) / s.look.sum() : 0.0},
                 {"milliseconds", percentiles(s.look)},
                 {"read_milliseconds", percentiles(s.read)}}}});
}

std::vector<std::string> frame_lines(const FrameFacts& facts, const SeenFrame& frame,
                                     const std::vector<std::string>& categories, std::size_t columns) {
  const std::string dropped = facts.dropped > 0 ? fmt::format(", {} dropped", facts.dropped) : "";
  std::vector<std::string> lines = {fmt::format("frame {}  {}  {:.1f} ms{}", facts.number, printable(facts.name),
                                                milliseconds(frame.seconds.all()), dropped)};
  if (const std::string reason = why_nothing(frame); !reason.empty()) {
    lines.push_back("  " + reason);
  }
  for (const SeenObject& object : frame.objects) {
    lines.push_back(object_line(object, categories));
  }
  for (std::string& each : lines) {
    each = cut_in_the_middle(each, columns);
  }
  return lines;
}

std::string summary_text(const CameraSummary& s) {
  std::string text = fmt::format("{} frames in {}, {} objects", s.frames, human_seconds(s.wall_seconds), s.objects);
  text += s.dropped > 0 ? fmt::format(", {} frames dropped", s.dropped) : "";
  text += s.failed > 0 ? fmt::format(", {} could not be read", s.failed) : "";
  text += "\n";
  text += times_line("a frame", s.look);
  text += times_line("reading", s.read);
  return text + fmt::format("{:.0f} frames a second without reading\n",
                            s.look.sum() > 0.0 ? static_cast<double>(s.frames) / s.look.sum() : 0.0);
}

}  // namespace spincat
