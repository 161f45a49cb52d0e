// librsvg is loaded, not linked: it brings two dozen libraries, which would cost every start of the command 10 ms.
#include <dlfcn.h>
#include <librsvg/rsvg.h>
#include <lodepng.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "spincat/error.h"
#include "spincat/report/confusion_picture.h"

namespace spincat {
namespace {

constexpr const char* kLibrary = "librsvg-2.so.2";  // Debian's librsvg2-2

// Its functions and those of the libraries beneath it.
struct Rsvg {
  Rsvg() : library(dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL)) {
    if (library == nullptr) {
      throw RunError(std::string("a PNG picture of the confusion matrix needs librsvg: ") + dlerror());
    }
    find("rsvg_handle_new_from_data", new_from_data);
    find("rsvg_handle_get_intrinsic_size_in_pixels", size_of);
    find("rsvg_handle_render_document", render);
    find("g_object_unref", unref);
    find("cairo_image_surface_create", new_surface);
    find("cairo_surface_destroy", destroy_surface);
    find("cairo_surface_flush", flush);
    find("cairo_surface_status", status);
    find("cairo_image_surface_get_data", data_of);
    find("cairo_image_surface_get_stride", stride_of);
    find("cairo_create", new_pen);
    find("cairo_destroy", destroy_pen);
  }

  template <class Function>
  void find(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    if (function == nullptr) {
      throw RunError(std::string(kLibrary) + " has no " + name);
    }
  }

  void* library;  // stays loaded: GLib cannot be unloaded
  decltype(rsvg_handle_new_from_data)* new_from_data = nullptr;
  decltype(rsvg_handle_get_intrinsic_size_in_pixels)* size_of = nullptr;
  decltype(rsvg_handle_render_document)* render = nullptr;
  decltype(g_object_unref)* unref = nullptr;
  decltype(cairo_image_surface_create)* new_surface = nullptr;
  decltype(cairo_surface_destroy)* destroy_surface = nullptr;
  decltype(cairo_surface_flush)* flush = nullptr;
  decltype(cairo_surface_status)* status = nullptr;
  decltype(cairo_image_surface_get_data)* data_of = nullptr;
  decltype(cairo_image_surface_get_stride)* stride_of = nullptr;
  decltype(cairo_create)* new_pen = nullptr;
  decltype(cairo_destroy)* destroy_pen = nullptr;
};

const Rsvg& rsvg() {
  static const Rsvg functions;
  return functions;
}

struct Pixels {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<std::uint8_t> rgb;
};

Pixels rendered(const std::string& svg, double scale) {
  const Rsvg& lib = rsvg();
  const auto* const bytes = reinterpret_cast<const guint8*>(svg.data());
  const std::unique_ptr<RsvgHandle, decltype(lib.unref)> handle(lib.new_from_data(bytes, svg.size(), nullptr),
                                                                lib.unref);
  double width = 0.0;
  double height = 0.0;
  if (!handle || lib.size_of(handle.get(), &width, &height) == 0) {
    throw RunError("librsvg cannot read the picture of the confusion matrix");
  }
  const RsvgRectangle place{0.0, 0.0, std::ceil(scale * width), std::ceil(scale * height)};
  Pixels pixels{static_cast<unsigned>(place.width), static_cast<unsigned>(place.height), {}};
  const std::unique_ptr<cairo_surface_t, decltype(lib.destroy_surface)> surface(
      lib.new_surface(CAIRO_FORMAT_RGB24, static_cast<int>(pixels.width), static_cast<int>(pixels.height)),
      lib.destroy_surface);
  const std::unique_ptr<cairo_t, decltype(lib.destroy_pen)> pen(lib.new_pen(surface.get()), lib.destroy_pen);
  if (lib.render(handle.get(), pen.get(), &place, nullptr) == 0 || lib.status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    throw RunError("librsvg cannot draw the picture of the confusion matrix");
  }
  lib.flush(surface.get());
  const std::uint8_t* const data = lib.data_of(surface.get());
  const auto stride = static_cast<std::size_t>(lib.stride_of(surface.get()));
  pixels.rgb.reserve(std::size_t{3} * pixels.width * pixels.height);
  for (std::size_t y = 0; y < pixels.height; ++y) {
    for (std::size_t x = 0; x < pixels.width; ++x) {
      const auto* const pixel = reinterpret_cast<const std::uint32_t*>(data + y * stride) + x;
      for (const unsigned shift : {16U, 8U, 0U}) {
        pixels.rgb.push_back(static_cast<std::uint8_t>(*pixel >> shift));
      }
    }
  }
  return pixels;
}

}  // namespace

std::string png_of_svg(const std::string& svg, double scale) {
  const Pixels pixels = rendered(svg, scale);
  std::vector<unsigned char> bytes;
  const unsigned error = lodepng::encode(bytes, pixels.rgb, pixels.width, pixels.height, LCT_RGB, 8);
  if (error != 0) {
    throw RunError(lodepng_error_text(error));
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace spincat
