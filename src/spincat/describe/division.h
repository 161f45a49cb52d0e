// The two ways to divide the work of spin images among ranks.
#pragma once

namespace spincat {

// Who encodes. Changes no result.
enum class Division {
  sums,    // whoever makes images encodes them, too, and returns sums
  images,  // the paper's: rank 0 prepares, images are returned, rank 0 encodes
};

}  // namespace spincat
