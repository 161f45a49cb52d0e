// Just enough SVG: a canvas that collects elements, and colours of even steps.
#pragma once

#include <string>
#include <string_view>

// A colour in OKLCh, where equal steps look equally large: lightness 0 to 1, chroma 0 (grey) to about 0.2, hue in
// degrees. As "#rrggbb"; what a screen cannot show is clipped.
std::string oklch(double lightness, double chroma, double hue);

// The heat map's colour for 0 <= t <= 1: from a dark violet over red to a light yellow, lightness growing evenly.
std::string heat_colour(double t);

// A number with at most one decimal: "12", "12.5".
std::string short_number(double value);

struct TextStyle {
  double size = 14.0;
  std::string_view colour = "#1f2733";
  bool bold = false;
  std::string_view anchor = "start";  // start, middle or end
};

class Svg {
 public:
  Svg(double width, double height, std::string_view title) : width_(width), height_(height), title_(title) {}

  void rect(double x, double y, double width, double height, std::string_view attributes);
  void circle(double x, double y, double radius, std::string_view attributes);
  void path(std::string_view commands, std::string_view attributes);
  void text(double x, double y, std::string_view text, const TextStyle& style = {});
  void begin_group(std::string_view attributes);
  void end_group();

  std::string finish() const;  // the whole file

 private:
  double width_;
  double height_;
  std::string title_;
  std::string body_;
};
