#include "spincat/prepare/prepare.h"

namespace spincat {

void PrepareSettings::validate() const {
  check_range("points", points, kPoints);
  check_range("spin_points", spin_points, kSpinPoints);
  check_range("neighbours", neighbours, kNeighbours);
}

}  // namespace spincat
