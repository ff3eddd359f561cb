// Clip lines in the plane of a splat.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/pairs/disc_tree.h"
#include "renderer/clip/pairs/partners.h"

namespace relief {

/// The border of a clip area in the coordinates of the splat's plane, its centre the origin: what
/// is beyond, dot(P, direction) > offset, is clipped.
struct PlaneLine {
  glm::dvec2 direction;   ///< unit
  double offset;          ///< negative if the centre is beyond
  glm::dvec2 edge;        ///< where the edge to the partner is: the line's point nearest to it
  std::uint32_t partner;  ///< which of the splat's partners, from 0
};

/// Lines whose areas are intersected.
using LineGroup = std::vector<PlaneLine>;

/// The plane of a splat as it is drawn.
struct SplatFrame {
  glm::dvec3 normal;
  glm::dvec3 x;  ///< unit, of ellipses the major axis
  glm::dvec3 y;
  double along_x;  ///< semi-axes
  double along_y;
};

[[nodiscard]] SplatFrame frame_of(const SplatDiscs& discs, const Disc& disc);

/// Returns the border of what a partner clips of a splat: what the partner does not see if the edge
/// is concave, otherwise what it sees. None if the partner's plane is nearly the drawn one (the
/// classification may have other normals).
[[nodiscard]] std::optional<PlaneLine> line_of(const SplatFrame& frame, const Disc& other,
                                               const Partner& partner, bool is_concave,
                                               std::uint32_t number);

}  // namespace relief
