// A vertex of the coarse meshes that are drawn for models seen from afar (proxy.h).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// The mean of some samples that are near each other and face the same way. Model frame.
struct ProxyVertex {
  glm::dvec3 position{0.0};
  glm::vec3 normal{0.0F};   ///< the mean of unit vectors: shorter the more they differ
  glm::vec3 colour{0.0F};   ///< linear
  std::uint32_t patch = 0;  ///< of one of the samples: in the run of patches
  glm::vec2 uv{0.0F};       ///< grid coordinates of that sample
};

}  // namespace relief
