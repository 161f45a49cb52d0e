// The confusion matrix as a picture for papers and chats.
#pragma once

#include <string>

#include "spincat/evaluate/evaluate.h"

namespace spincat {

// As an SVG file: rows are the truth, columns the names, each cell shaded by its share of the row, with its count where
// there is room; the rate above. Long names are cut in the middle. Names, whatever is in them, are text. Deterministic.
std::string confusion_svg(const Evaluation& evaluation);

// An SVG picture as the bytes of a PNG file, `scale` pixels for each of its units. Rendered by librsvg, which is loaded
// when it is first needed. Throws RunError when it is not installed, or when memory is short.
std::string png_of_svg(const std::string& svg, double scale = 2.0);

}  // namespace spincat
