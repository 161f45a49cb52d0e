// Files that the library carries within itself (cmake/embed.cmake).
#pragma once

#include <cstddef>
#include <string_view>

namespace spincat::embedded {

std::string_view page_html();
std::string_view page_css();
std::string_view common_js();
std::string_view evaluation_js();
std::string_view sweep_js();
std::string_view viewer_js();
std::string_view object_js();
std::string_view classification_js();
std::string_view three_js();     // Debian's libjs-three
std::string_view controls_js();  // its OrbitControls
std::string_view live_html();

}  // namespace spincat::embedded
