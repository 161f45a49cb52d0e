#include "svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

// Linear light to an sRGB byte.
int srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255.0 * encoded));
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

std::string oklch(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180.0;
  const double a = chroma * std::cos(angle);
  const double b = chroma * std::sin(angle);
  // OKLab to cone responses to linear sRGB, by its definition
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return fmt::format("#{:02x}{:02x}{:02x}", srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                     srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                     srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s));
}

std::string heat_colour(double t) {
  const double chroma = 0.05 + 0.13 * std::sin(std::numbers::pi * std::clamp(0.1 + 0.8 * t, 0.0, 1.0));
  return oklch(0.20 + 0.74 * t, chroma, 285.0 + 180.0 * t);
}

std::string short_number(double value) {
  const double rounded = std::round(value * 10.0) / 10.0;
  return fmt::format("{}", rounded == 0.0 ? 0.0 : rounded);
}

void Svg::rect(double x, double y, double width, double height, std::string_view attributes) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", short_number(x), short_number(y),
                       short_number(width), short_number(height), attributes);
}

void Svg::circle(double x, double y, double radius, std::string_view attributes) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", short_number(x), short_number(y),
                       short_number(radius), attributes);
}

void Svg::path(std::string_view commands, std::string_view attributes) {
  body_ += fmt::format("<path {} d=\"{}\"/>\n", attributes, commands);
}

void Svg::text(double x, double y, std::string_view text, const TextStyle& style) {
  body_ +=
      fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}{}>{}</text>\n", short_number(x),
                  short_number(y), short_number(style.size), style.colour, style.bold ? " font-weight=\"600\"" : "",
                  style.anchor == "start" ? "" : fmt::format(" text-anchor=\"{}\"", style.anchor), escaped(text));
}

void Svg::begin_group(std::string_view attributes) {
  body_ += fmt::format("<g {}>\n", attributes);
}

void Svg::end_group() {
  body_ += "</g>\n";
}

std::string Svg::finish() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif\">\n"
      "<title>{2}</title>\n{3}</svg>\n",
      short_number(width_), short_number(height_), escaped(title_), body_);
}
