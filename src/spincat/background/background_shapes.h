// Shapes that stand for everything that is none of the categories learned: what judges of strangers learn from.
#pragma once

#include <cstdint>

#include "spincat/geometry/object.h"

namespace spincat {

// How many families there are (families.h): shape number n is of family n modulo this.
inline constexpr std::uint32_t kBackgroundFamilies = 67;

// How many background shapes there are. Any first ones of them hold as many of each family as possible.
inline constexpr std::uint32_t kBackgroundShapes = 536;

// Background shape number `number`, made by code alone: vessels, tools, animals, plants, vehicles, buildings, surfaces
// of formulas and random assemblies (families.h), drawn neither from nor towards any collection of models. Closed and
// open pieces overlap: only what is seen from outside means anything, not size or place. At most 20,000 triangles.
// Deterministic. Precondition: number < kBackgroundShapes.
Mesh background_shape(std::uint32_t number);

}  // namespace spincat
