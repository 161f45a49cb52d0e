#include "spincat/report/confusion_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>

#include "spincat/report/text_table.h"

namespace spincat {
namespace {

constexpr std::size_t kLongestLabel = 20;
constexpr double kMargin = 14.0;
constexpr double kTitle = 46.0;  // height of the lines above the matrix
using Colour = std::array<double, 3>;
constexpr Colour kRight = {24, 110, 190};  // as on the page
constexpr Colour kWrong = {214, 94, 10};

// Text inside an element: no markup, nothing that XML forbids.
std::string xml_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("\xEF\xBF\xBE") || rest.starts_with("\xEF\xBF\xBF")) {  // no characters, says XML
      result += "?";
      i += 2;
    } else if (text[i] == '&') {
      result += "&amp;";
    } else if (text[i] == '<') {
      result += "&lt;";
    } else if (text[i] == '>') {
      result += "&gt;";
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string shown_name(const std::string& name) {
  return xml_text(cut_in_the_middle(printable(name), kLongestLabel));
}

struct Layout {
  explicit Layout(const Evaluation& e) : categories(e.categories.size()) {
    cell = categories <= 12 ? 36.0 : categories <= 24 ? 26.0 : categories <= 50 ? 15.0 : 10.0;
    font = std::min(13.0, cell * 0.8);
    std::size_t longest = 0;
    for (const std::string& name : e.categories) {
      longest = std::max(longest, text_width(cut_in_the_middle(printable(name), kLongestLabel)));
    }
    label = 0.62 * font * static_cast<double>(longest) + 10.0;
    left = kMargin + label + font + 8.0;
    top = kMargin + kTitle + label;
  }
  double side() const { return cell * static_cast<double>(categories); }
  double width() const { return std::max(left + side() + kMargin, 400.0); }
  double height() const { return top + side() + font + 2.0 * kMargin; }
  bool has_counts() const { return cell >= 26.0; }

  std::size_t categories;
  double cell = 0.0;   // of the matrix, both ways
  double font = 0.0;   // of names
  double label = 0.0;  // room for the longest name
  double left = 0.0;   // where the matrix begins
  double top = 0.0;
};

std::string text_at(double x, double y, double size, std::string_view more, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" {}>{}</text>\n", x, y, size, more, text);
}

std::string mixed(const Colour& colour, double share) {
  std::array<int, 3> rgb{};
  std::ranges::transform(colour, rgb.begin(),
                         [&](double full) { return static_cast<int>(std::lround(255.0 + share * (full - 255.0))); });
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string cells(const Evaluation& e, const Layout& layout) {
  std::string svg;
  for (std::size_t i = 0; i < layout.categories; ++i) {
    const double total = std::accumulate(e.confusion[i].begin(), e.confusion[i].end(), 0.0);
    for (std::size_t j = 0; j < layout.categories; ++j) {
      const std::uint32_t count = e.confusion[i][j];
      const double x = layout.left + layout.cell * static_cast<double>(j);
      const double y = layout.top + layout.cell * static_cast<double>(i);
      const double share = count > 0 ? 0.12 + 0.88 * count / total : 0.0;  // even a single mistake must be seen
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" stroke=\"#d9dee6\"/>\n", x, y,
          layout.cell, layout.cell, mixed(i == j ? kRight : kWrong, share));
      if (count > 0 && layout.has_counts()) {
        const char* const ink = share > 0.6 ? "text-anchor=\"middle\" fill=\"#ffffff\"" : "text-anchor=\"middle\"";
        const double size = count < 1000 ? 11.0 : 9.0;
        svg += text_at(x + layout.cell / 2, y + layout.cell / 2 + 4.0, size, ink, fmt::format("{}", count));
      }
    }
  }
  return svg;
}

std::string names(const Evaluation& e, const Layout& layout) {
  std::string svg;
  for (std::size_t c = 0; c < layout.categories; ++c) {
    const double middle = layout.cell * (static_cast<double>(c) + 0.5) + layout.font * 0.35;
    const std::string name = shown_name(e.categories[c]);
    svg += text_at(layout.left - 6.0, layout.top + middle, layout.font, "text-anchor=\"end\"", name);
    const double x = layout.left + middle;
    svg += text_at(x, layout.top - 6.0, layout.font,
                   fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", x, layout.top - 6.0), name);
  }
  return svg;
}

std::string captions(const Evaluation& e, const Layout& layout) {
  const std::string spread =
      e.protocol == Protocol::splits ? fmt::format(" ± {:.3f}", e.mean_class_rate.deviation) : "";
  const double x = layout.left + layout.side() / 2;
  const double y = layout.top + layout.side() / 2;
  constexpr double kAcross = 14.0 * 0.62;
  const auto room = static_cast<std::size_t>((layout.width() - 2 * kMargin) / kAcross);
  const std::string soft = "fill=\"#5a6577\" text-anchor=\"middle\"";
  return text_at(kMargin, kMargin + 10.0, 14.0, "font-weight=\"bold\"",
                 xml_text(cut_in_the_middle(printable(e.dataset), room))) +
         text_at(kMargin, kMargin + 28.0, 12.0, "fill=\"#5a6577\"",
                 fmt::format("mean-class rate {:.3f}{}, overall rate {:.3f}", e.mean_class_rate.mean, spread,
                             e.overall_rate.mean)) +
         text_at(x, layout.top + layout.side() + layout.font + 6.0, 12.0, soft, "named as") +
         text_at(kMargin + 4.0, y, 12.0,
                 fmt::format("{} transform=\"rotate(-90 {:.1f} {:.1f})\"", soft, kMargin + 4.0, y), "truth");
}

}  // namespace

std::string confusion_svg(const Evaluation& e) {
  const Layout layout(e);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
             "{1:.0f}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"#1b2230\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             layout.width(), layout.height()) +
         captions(e, layout) + names(e, layout) + cells(e, layout) + "</svg>\n";
}

}  // namespace spincat
