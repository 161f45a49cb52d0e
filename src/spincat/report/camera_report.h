// What a depth camera's frames came to, as JSON and as text.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spincat/classify/recogniser.h"
#include "spincat/report/time_histogram.h"

namespace spincat {

// A frame as the command met it.
struct FrameFacts {
  std::size_t number = 0;  // of the source's frames, from 0
  std::string name;
  double time = 0.0;  // seconds, as the source tells it
  int width = 0;      // of the picture, in pixels
  int height = 0;
  double read_seconds = 0.0;  // reading and decoding it
  std::size_t dropped = 0;    // frames so far that came while another was looked at
};

// What a whole run came to.
struct CameraSummary {
  std::size_t frames = 0;   // looked at
  std::size_t failed = 0;   // could not be read
  std::size_t dropped = 0;  // frames that came while another was looked at
  std::size_t objects = 0;  // in all frames
  bool gave_up = false;     // after too many frames in a row that could not be read: there were more
  TimeHistogram look;       // table, objects and names of a frame
  TimeHistogram read;
  double wall_seconds = 0.0;
};

// One line without its end. Keys: docs/reference/json.md. The same frames give the same text, but for "milliseconds"
// and "dropped".
std::string frame_json(const FrameFacts& facts, const SeenFrame& frame, const std::vector<std::string>& categories);
std::string frame_error_json(std::size_t number, const std::string& error);
std::string summary_json(const CameraSummary& summary);

// Why there is no object: "no table: ..."; empty where there is one.
std::string why_nothing(const SeenFrame& frame);

// A line for the frame and one for each object, for a terminal of so many columns.
std::vector<std::string> frame_lines(const FrameFacts& facts, const SeenFrame& frame,
                                     const std::vector<std::string>& categories, std::size_t columns);

// Frames, percentiles and frames a second, in a few lines.
std::string summary_text(const CameraSummary& summary);

}  // namespace spincat
