// Pictures without a browser: grey values and their PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spincat/spin/spin_images.h"

namespace spincat {

// width x height grey values, row by row from the top; 0 is black.
struct GreyPicture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> values;
};

// A contact sheet: the images side by side in rows (the channels of one image next to each other), each bin a square of
// several pixels, thin lines between. Dark means full, as in Johnson's figures; each image is scaled to its own fullest
// bin, and the square root makes the sparse bins visible.
GreyPicture contact_sheet(const SpinImages& images);

// The bytes of a PNG file (lodepng). Throws RunError when memory is short.
std::string encode_png(const GreyPicture& picture);

}  // namespace spincat
