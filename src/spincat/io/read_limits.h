// Limits while reading, so that a damaged or hostile file cannot take the machine down. The options of the command that
// raise them are called as they are: --max-points, --max-triangles, --max-growth.
#pragma once

#include <cstddef>
#include <cstdint>

#pragma GCC visibility push(default)
namespace spincat {

struct ReadLimits {
  std::size_t max_points = 100'000'000;     // vertices or points
  std::size_t max_triangles = 200'000'000;  // after polygons are cut into triangles
  // Bytes of memory for each byte of a file, besides 16 MB, where a file packs or repeats what it holds: compressed
  // points and meshes, meshes that many nodes of a scene show, a list of very many very short lines.
  std::size_t max_growth = 20;
};

// Throws InputError (without a file name) when `memory` bytes are more than a file of `file_size` bytes may take. For
// formats in which a few bytes can ask for any amount of memory.
void check_growth(std::uint64_t memory, std::uint64_t file_size, const ReadLimits& limits);

}  // namespace spincat
#pragma GCC visibility pop
