// What spin points say, as pages show it.
#pragma once

#include <cstddef>

#include "spincat/classify/evidence.h"
#include "spincat/judge/ballot.h"
#include "spincat/report/json_parts.h"

namespace spincat {

// {"unit", "values": L 16-bit numbers}: margins as multiples of `unit`, 0.001 or as much larger a power of ten as the
// largest needs.
Json margins_json(const Ballot& ballot);

// {"kind": "shares" or "leaving-out", "winner", "runner_up", "margin",
//  "parts": [{"surface", "axes", "spin_points": of all, "points": of those shown, "strongest", "values": 16-bit
//  numbers,
//             32767 is `strongest`}],
//  "images": [{"part", "point", "value", "rows", "columns", "channels", "values": grey, dark is full}]}: those of the
// points that speak most for the winner, then of those that speak most against it.
Json evidence_json(const Evidence& evidence, std::size_t image_rows);

}  // namespace spincat
