// Where on an object the evidence for its name lies: what each spin point says for the winner against the runner-up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spincat/classify/model.h"
#include "spincat/describe/describe.h"
#include "spincat/geometry/object.h"
#include "spincat/judge/ballot.h"

#pragma GCC visibility push(default)
namespace spincat {

enum class EvidenceKind {
  shares,       // of the margin: those of all spin points add up to it (up to rounding)
  leaving_out,  // by how much the margin falls when the spin point is left out; these need not add up to anything
};

// The most spin points of one part and draw that are left out, one after the other.
inline constexpr std::size_t kMostLeftOut = 1024;

// Spin points of one part of the feature vector, in one draw, and what they say.
struct PartEvidence {
  PreparedPart prepared;
  std::vector<float> of_point;  // of the first spin points (which are in random order), > 0 speaks for the winner: of
                                // all of them with EvidenceKind::shares, else of kMostLeftOut at most
};

struct Evidence {
  EvidenceKind kind = EvidenceKind::shares;
  std::uint32_t winner = 0;
  std::uint32_t runner_up = 0;
  float margin = 0.0F;  // of the judge of these two, > 0 for the winner
  std::vector<PartEvidence> parts;
};

// Explains a ballot of the model on the object. Deterministic. Throws as classify does.
//
// With linear judges the evidence is exact for the encodings pooled-pyramid, mean-image and concatenation. The margin
// is w . x + b; every feature x_j is a sum over the spin points, once the lengths that x was scaled to and the mean
// mu_j and deviation s_j of each pooled bin are held at what they are in the whole object:
//
//   mean of n roots r_kj:            point k gives r_kj / n
//   their standard deviation s_j:    point k gives (r_kj - mu_j)^2 / (n s_j), as s_j = s_j^2 / s_j
//
// A point's evidence is w times what it gives, and an equal part of b. With other kernels and encodings points are left
// out (Encoding::ObjectSums::finish_without); the surface keeps all its points.
//
// Spin images are made twice and not kept: memory does not grow with their number.
Evidence explain(const Model& model, const Object& object, const Ballot& ballot);

}  // namespace spincat
#pragma GCC visibility pop
