// The surface between patches that end where their neighbours begin.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// A vertex that patches share.
struct SeamVertex {
  glm::dvec3 position{0.0};  ///< world
  std::uint32_t patch = 0;   ///< one of those that share it
};

/// A corner of a patch's triangles: one of its nodes (j * width + i), or with this bit one of the
/// seam vertices.
inline constexpr std::uint32_t kSeamVertexBit = 0x80000000U;

/// What closes the surface of some patches about their whole cells (kWholeCell). Seen from outside,
/// triangles are counterclockwise.
struct Seams {
  std::vector<SeamVertex> vertices;
  /// By patch: those of cells with three samples, and its share of the strips between patches.
  std::vector<std::vector<Triangle>> triangles;
};

}  // namespace relief
