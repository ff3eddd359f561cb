#include "common/neighbours/morton.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <numeric>

namespace relief {
namespace {

/// Puts two zeros between any two of the lowest twenty bits of a number.
std::uint64_t spread_bits(std::uint64_t n) {
  n = (n | n << 32U) & 0x001F00000000FFFFU;
  n = (n | n << 16U) & 0x001F0000FF0000FFU;
  n = (n | n << 8U) & 0x100F00F00F00F00FU;
  n = (n | n << 4U) & 0x10C30C30C30C30C3U;
  return (n | n << 2U) & 0x1249249249249249U;
}

}  // namespace

std::uint64_t morton_code(glm::dvec3 position, const Bounds& box) {
  constexpr double kSteps = 1U << kMortonBits / 3;
  const glm::dvec3 size = box.max - box.min;
  const double scale = kSteps / std::max({size.x, size.y, size.z, 1e-300});
  if (!(scale > 0.0)) return 0;  // the box is too wide for doubles
  const glm::dvec3 at = glm::clamp((position - box.min) * scale, 0.0, kSteps - 1.0);
  return spread_bits(static_cast<std::uint64_t>(at.x)) |
         spread_bits(static_cast<std::uint64_t>(at.y)) << 1U |
         spread_bits(static_cast<std::uint64_t>(at.z)) << 2U;
}

std::vector<std::uint32_t> order_of(std::span<const std::uint64_t> codes) {
  // By ten bits at a time, which takes a quarter of the time of comparisons.
  constexpr unsigned kDigitBits = 10;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  constexpr std::size_t kRounds = (64 + kDigitBits - 1) / kDigitBits;
  const auto digit = [](std::uint64_t code, std::size_t round) {
    return code >> round * kDigitBits & (kDigits - 1);
  };
  std::array<std::array<std::uint32_t, kDigits>, kRounds> counts{};
  for (const std::uint64_t code : codes) {
    for (std::size_t round = 0; round < kRounds; ++round) ++counts[round][digit(code, round)];
  }
  std::vector<std::uint32_t> order(codes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint32_t> sorted(codes.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    std::array<std::uint32_t, kDigits>& starts = counts[round];
    // Most codes have leading zeros.
    if (std::ranges::find(starts, codes.size()) != starts.end()) continue;
    std::exclusive_scan(starts.begin(), starts.end(), starts.begin(), 0U);
    for (const std::uint32_t k : order) sorted[starts[digit(codes[k], round)]++] = k;
    order.swap(sorted);
  }
  return order;
}

std::vector<std::uint32_t> places_in(std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> places(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) places[order[k]] = k;
  return places;
}

}  // namespace relief
