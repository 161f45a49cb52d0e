// KHR_draco_mesh_compression: primitives that Draco has compressed. Private to io.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spincat::io {

// Unpacks the positions, joints, weights and corners of every compressed primitive into new buffers and gives it
// accessors of these. A primitive whose accessors have data of their own, for those that know no Draco, keeps them.
// expect_memory is told how many bytes are taken by all of it, and may throw. Returns how many stay taken. Throws
// InputError where a mesh is damaged, or this spincat was built without Draco.
std::uint64_t unpack_draco_primitives(nlohmann::json& document, std::vector<std::string>& buffers,
                                      const std::function<void(std::uint64_t)>& expect_memory);

}  // namespace spincat::io
