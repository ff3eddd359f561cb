// Filling cube maps, on all cores.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "renderer/shading/environment/cube_map.h"

namespace relief {

/// Fills the faces with `light(face, st)`; st is the middle of a texel in [-1, 1].
template <class Light>
[[nodiscard]] CubeMap make_cube(std::uint32_t size, const Light& light) {
  CubeMap cube;
  cube.size = size;
  for (auto& face : cube.faces) face.resize(std::size_t{size} * size);
  tbb::parallel_for(std::size_t{0}, std::size_t{6} * size, [&](std::size_t row) {
    const std::size_t face = row / size;
    const std::size_t y = row % size;
    for (std::size_t x = 0; x < size; ++x) {
      const glm::dvec2 middle(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      cube.faces[face][y * size + x] = light(face, 2.0 * middle / static_cast<double>(size) - 1.0);
    }
  });
  return cube;
}

}  // namespace relief
