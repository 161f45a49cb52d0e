// The families of background shapes: each makes one shape of its kind, any other for any other random numbers. Size and
// place of a shape mean nothing. Deterministic.
#pragma once

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"

namespace spincat::background {

// Turned on a lathe (turned_shapes.cpp).
Mesh vase(Random& random);
Mesh turned_part(Random& random);
Mesh bottle(Random& random);
Mesh mug(Random& random);
Mesh goblet(Random& random);
Mesh wheel(Random& random);
Mesh dish(Random& random);
Mesh umbrella(Random& random);
Mesh hat(Random& random);

// Given by a formula (formula_shapes.cpp).
Mesh superquadric(Random& random);
Mesh wavy_ring(Random& random);
Mesh knot(Random& random);
Mesh spring(Random& random);
Mesh snail_shell(Random& random);
Mesh blob(Random& random);
Mesh crystal(Random& random);
Mesh wavy_sheet(Random& random);
Mesh landscape(Random& random);

// Cut from plates and bars (flat_shapes.cpp).
Mesh gear(Random& random);
Mesh random_plate(Random& random);
Mesh letter(Random& random);
Mesh grating(Random& random);
Mesh blade(Random& random);
Mesh hand_tool(Random& random);
Mesh gun(Random& random);
Mesh guitar(Random& random);
Mesh screen(Random& random);
Mesh spectacles(Random& random);
Mesh lattice(Random& random);

// Animals and people (animal_shapes.cpp).
Mesh quadruped(Random& random);
Mesh person(Random& random);
Mesh bird(Random& random);
Mesh insect(Random& random);
Mesh fish(Random& random);
Mesh head(Random& random);
Mesh hand(Random& random);
Mesh worm(Random& random);

// Plants (plant_shapes.cpp).
Mesh bare_tree(Random& random);
Mesh leafy_tree(Random& random);
Mesh conifer(Random& random);
Mesh palm(Random& random);
Mesh potted_plant(Random& random);
Mesh flower(Random& random);
Mesh mushrooms(Random& random);

// What drives, flies and swims (vehicle_shapes.cpp).
Mesh car(Random& random);
Mesh lorry(Random& random);
Mesh tank(Random& random);
Mesh bicycle(Random& random);
Mesh ship(Random& random);
Mesh sailing_boat(Random& random);
Mesh aeroplane(Random& random);
Mesh helicopter(Random& random);
Mesh spaceship(Random& random);
Mesh rocket(Random& random);

// Buildings (building_shapes.cpp).
Mesh house(Random& random);
Mesh castle(Random& random);
Mesh temple(Random& random);
Mesh dome(Random& random);
Mesh town(Random& random);
Mesh bridge(Random& random);
Mesh stairs(Random& random);
Mesh lantern(Random& random);

// Put together at random (assembled_shapes.cpp).
Mesh stack(Random& random);
Mesh cluster(Random& random);
Mesh mirror_cluster(Random& random);
Mesh star_cluster(Random& random);
Mesh rods(Random& random);

}  // namespace spincat::background
