#include <cmath>
#include <cstdint>
#include <vector>

#include "harness.h"
#include "sections.h"
#include "spincat/geometry/aligned.h"
#include "spincat/geometry/random.h"

namespace spincat::bench {
namespace {

constexpr std::size_t kPairs = 1 << 12;

// Keeps the compiler from leaving out what computes `value`.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

// Adds four floats to one of 400 cells, in random order: the least that a bilinear spin image must do for each pair.
void read_modify_write(const AlignedFloats& shares, const std::vector<std::uint32_t>& cells, AlignedFloats& sums) {
  using Four = float __attribute__((vector_size(16)));
  const auto* from = reinterpret_cast<const Four*>(shares.data());
  auto* to = reinterpret_cast<Four*>(sums.data());
  for (std::size_t i = 0; i < kPairs; ++i) {
    to[cells[i]] += from[i];
  }
  keep(sums[0]);
}

// alpha^2 and beta of many points against one, summed.
void alpha_beta(const AlignedFloats& xyz, AlignedFloats& sums) {
  const float* x = xyz.data();
  const float* y = x + kPairs;
  const float* z = y + kPairs;
  for (std::size_t i = 0; i < kPairs; i += 64) {
    for (std::size_t lane = 0; lane < 64; ++lane) {
      const float dx = x[i + lane] - 0.1F;
      const float dy = y[i + lane] - 0.2F;
      const float dz = z[i + lane] - 0.3F;
      const float beta = 0.6F * dx + 0.8F * dy + 0.1F * dz;
      sums[lane] += std::sqrt(std::abs(dx * dx + dy * dy + dz * dz - beta * beta)) + beta;
    }
  }
  keep(sums[0]);
}

}  // namespace

nlohmann::ordered_json machine_limits(int rounds) {
  Random random(1);
  AlignedFloats shares(4 * kPairs, 0.25F);
  AlignedFloats sums(4 * 400, 0.0F);
  AlignedFloats xyz(3 * kPairs, 0.0F);
  AlignedFloats huge(std::size_t{1} << 26, 1.0F);
  std::vector<std::uint32_t> cells(kPairs);
  for (std::uint32_t& cell : cells) {
    cell = static_cast<std::uint32_t>(random.below(400));
  }
  for (float& value : xyz) {
    value = static_cast<float>(random.uniform());
  }
  const auto read_all = [&] {
    std::vector<float> lanes(64, 0.0F);
    for (std::size_t i = 0; i < huge.size(); i += 64) {
      for (std::size_t lane = 0; lane < 64; ++lane) {
        lanes[lane] += huge[i + lane];
      }
    }
    keep(lanes[0]);
  };
  return race({{"read_modify_write_16_bytes", kPairs, [&] { read_modify_write(shares, cells, sums); }},
               {"alpha_beta_pairs", kPairs, [&] { alpha_beta(xyz, sums); }},
               {"memory_bytes_read", static_cast<double>(huge.size() * sizeof(float)), read_all}},
              rounds, 0.05);
}

}  // namespace spincat::bench
