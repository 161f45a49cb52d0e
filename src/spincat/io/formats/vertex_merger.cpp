#include "spincat/io/formats/vertex_merger.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat::io {
namespace {

// Spreads every bit over all others (the finaliser of MurmurHash3).
std::uint64_t mix(std::uint64_t bits) {
  bits = (bits ^ (bits >> 33)) * 0xFF51AFD7ED558CCDULL;
  bits = (bits ^ (bits >> 33)) * 0xC4CEB9FE1A85EC53ULL;
  return bits ^ (bits >> 33);
}

}  // namespace

VertexMerger::VertexMerger() : slots_(1024, kEmpty) {
  std::random_device random;
  key_ = (static_cast<std::uint64_t>(random()) << 32) | random();
}

std::size_t VertexMerger::hash(const Vec3& position) const {
  std::uint64_t bits = key_;
  for (const double c : position) {
    bits = mix(bits ^ std::bit_cast<std::uint64_t>(c + 0.0));  // -0.0 + 0.0 is 0.0
  }
  return bits;
}

std::uint32_t VertexMerger::index_of(const Vec3& position, std::vector<Vec3>& vertices) {
  if (vertices.size() >= slots_.size() / 2) {
    grow(vertices);
  }
  std::size_t slot = hash(position) & (slots_.size() - 1);
  while (slots_[slot] != kEmpty) {
    if (vertices[slots_[slot]] == position) {
      return slots_[slot];
    }
    slot = (slot + 1) & (slots_.size() - 1);
  }
  slots_[slot] = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back(position);
  return slots_[slot];
}

void VertexMerger::grow(const std::vector<Vec3>& vertices) {
  slots_.assign(2 * slots_.size(), kEmpty);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    std::size_t slot = hash(vertices[i]) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = i;
  }
}

}  // namespace spincat::io
