#include "spincat/background/background_shapes.h"

#include <array>
#include <cassert>

#include "spincat/background/families.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Family = Mesh (*)(Random&);

// In the order of families.h, from which numbers count on: a new family belongs to the end of both.
constexpr std::array kFamilies = {
    background::vase,         background::turned_part,    background::bottle,
    background::mug,          background::goblet,         background::wheel,
    background::dish,         background::umbrella,       background::hat,
    background::superquadric, background::wavy_ring,      background::knot,
    background::spring,       background::snail_shell,    background::blob,
    background::crystal,      background::wavy_sheet,     background::landscape,
    background::gear,         background::random_plate,   background::letter,
    background::grating,      background::blade,          background::hand_tool,
    background::gun,          background::guitar,         background::screen,
    background::spectacles,   background::lattice,        background::quadruped,
    background::person,       background::bird,           background::insect,
    background::fish,         background::head,           background::hand,
    background::worm,         background::bare_tree,      background::leafy_tree,
    background::conifer,      background::palm,           background::potted_plant,
    background::flower,       background::mushrooms,      background::car,
    background::lorry,        background::tank,           background::bicycle,
    background::ship,         background::sailing_boat,   background::aeroplane,
    background::helicopter,   background::spaceship,      background::rocket,
    background::house,        background::castle,         background::temple,
    background::dome,         background::town,           background::bridge,
    background::stairs,       background::lantern,        background::stack,
    background::cluster,      background::mirror_cluster, background::star_cluster,
    background::rods,
};
static_assert(kFamilies.size() == kBackgroundFamilies);

constexpr std::uint64_t kSeed = 19;  // of all shapes

}  // namespace

Mesh background_shape(std::uint32_t number) {
  assert(number < kBackgroundShapes);
  Random random(derive_seed(kSeed, number));
  const Family family = kFamilies[number % kFamilies.size()];
  return family(random);
}

}  // namespace spincat
