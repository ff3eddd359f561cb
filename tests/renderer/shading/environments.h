// Environments for tests of shading.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>

#include "renderer/shading/environment/cube_map.h"

namespace relief::test {

/// An environment whose light is `light(direction)`.
template <class Light>
[[nodiscard]] CubeMap environment_of(std::uint32_t size, const Light& light) {
  CubeMap cube;
  cube.size = size;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const glm::dvec2 st = (2.0 * glm::dvec2(x, y) + 1.0) / static_cast<double>(size) - 1.0;
        cube.faces[face].push_back(light(glm::normalize(cube_direction(face, st))));
      }
    }
  }
  return cube;
}

}  // namespace relief::test
