// Fills the texels over holes with values that continue their surroundings.
#pragma once

#include <cassert>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/patch.h"

namespace relief {

/// Sets every texel whose `kept` is 0 to the rounded mean of its eight neighbours that have a value
/// already, ring by ring outward from the kept ones. A map without any kept texel stays as it is.
/// Means of octahedral normals are correct as long as none crosses the octahedron's fold, that is,
/// for normals in the upper half space.
template <class Texel>
void continue_over_holes(AttributeMap<Texel>& map, std::span<const std::uint8_t> kept) {
  enum State : std::uint8_t { Unknown, Known, Queued };
  std::vector<std::uint8_t> state(kept.begin(), kept.end());
  const std::size_t width = map.width;
  const std::size_t height = map.height;
  assert(state.size() == width * height);
  if (width == 0) return;

  const auto for_neighbours = [width, height](std::size_t k, const auto& visit) {
    const std::size_t i = k % width;
    const std::size_t j = k / width;
    for (std::size_t y = j > 0 ? j - 1 : 0; y <= j + 1 && y < height; ++y) {
      for (std::size_t x = i > 0 ? i - 1 : 0; x <= i + 1 && x < width; ++x) {
        visit(y * width + x);
      }
    }
  };
  const auto queue_neighbours = [&](std::size_t k, std::vector<std::size_t>& ring) {
    for_neighbours(k, [&](std::size_t n) {
      if (state[n] != Unknown) return;
      state[n] = Queued;
      ring.push_back(n);
    });
  };

  std::vector<std::size_t> ring;
  for (std::size_t k = 0; k < state.size(); ++k) {
    if (state[k] == Known) queue_neighbours(k, ring);
  }
  std::vector<std::size_t> next;
  while (!ring.empty()) {
    for (const std::size_t k : ring) {
      glm::vec<Texel::length(), std::int32_t> sum(0);
      std::int32_t count = 0;
      for_neighbours(k, [&](std::size_t n) {
        if (state[n] != Known) return;
        sum += glm::vec<Texel::length(), std::int32_t>(map.texels[n]);
        ++count;
      });
      assert(count > 0 && "what is queued has a neighbour with a value");
      // floor(mean + 1/2), for either sign.
      for (glm::length_t c = 0; c < Texel::length(); ++c) {
        const std::int32_t twice = 2 * sum[c] + count;
        const std::int32_t floor =
            twice >= 0 ? twice / (2 * count) : -((2 * count - 1 - twice) / (2 * count));
        map.texels[k][c] = static_cast<typename Texel::value_type>(floor);
      }
    }
    next.clear();
    for (const std::size_t k : ring) state[k] = Known;
    for (const std::size_t k : ring) queue_neighbours(k, next);
    ring.swap(next);
  }
}

}  // namespace relief
