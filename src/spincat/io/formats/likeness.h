// What the first bytes of a file tell about its format, whatever the file is called. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace spincat::io {

// Whether a file may be of a format. `plain` is said only where no file of another format begins so.
enum class Likeness { none, possible, plain };

// As many of a file's first bytes as the functions below get to see.
constexpr std::size_t kLookedAt = 16'384;

Likeness likeness_of_off(std::string_view first, std::uint64_t file_size);
Likeness likeness_of_obj(std::string_view first, std::uint64_t file_size);
Likeness likeness_of_ply(std::string_view first, std::uint64_t file_size);
Likeness likeness_of_stl(std::string_view first, std::uint64_t file_size);
Likeness likeness_of_pcd(std::string_view first, std::uint64_t file_size);
Likeness likeness_of_gltf(std::string_view first, std::uint64_t file_size);

// Plain where all lines are rows of three numbers or more, but for comments, the names of columns and counts of points,
// and there are five rows: notes may have a line of numbers, or the four of a matrix.
Likeness likeness_of_xyz(std::string_view first, std::uint64_t file_size);

// What a file is that begins like none of these: "a zip archive"; empty where that cannot be said.
std::string_view unread_kind(std::string_view first);

}  // namespace spincat::io
