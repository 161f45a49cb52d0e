// Which way is up.
#pragma once

namespace spincat {

// The axis of a file that points up, where it is known.
enum class UpAxis { none, x, y, z };

}  // namespace spincat
