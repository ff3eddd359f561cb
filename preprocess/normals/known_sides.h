// What is known about the side that normals face.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "common/points.h"

namespace relief {

class SampledSides;

/// The side that normals of bare points face, as asked for.
enum class NormalSide {
  Auto,     ///< towards the scanner if the file tells where it was; otherwise found out
  Up,       ///< along SideChoice::up
  Outward,  ///< out of what the surface encloses, wherever the scanner was
  Toward,   ///< towards a position
};

struct SideChoice {
  NormalSide side = NormalSide::Auto;
  glm::dvec3 toward{0.0};        ///< for Toward, in the frame of the points
  glm::dvec3 up{0.0, 0.0, 1.0};  ///< +Z of the world, in the frame of the points; unit
  /// Of the scan of which the points are a part, for Auto and Outward; null: they are all of it.
  const SampledSides* whole = nullptr;
};

/// Directions that are less along the normal don't tell its side: the surface is seen edge on.
inline constexpr float kSureCosine = 0.25F;

/// The direction that normals of a scan shall have.
struct KnownSides {
  std::optional<glm::dvec3> viewpoint{};  ///< towards this position; nothing: up
  glm::vec3 up{0.0F, 0.0F, 1.0F};         ///< as SideChoice has it
  bool is_of_scanners = false;            ///< towards each point's own scanner instead
  const SampledSides* whole = nullptr;    ///< the whole scan's normals instead, if not null
  /// What a direction counts beside the winding numbers, which are a half about a closed surface.
  float weight = 0.0F;
  bool leads_slivers = false;  ///< it decides for pieces too small for winding numbers
  bool is_sure = false;  ///< the direction alone decides, wherever it is not along the surface

  /// The unit direction at a point.
  [[nodiscard]] glm::vec3 direction_at(const Points& points, std::size_t point) const;
};

/// Returns what the choice and the file tell.
[[nodiscard]] KnownSides known_sides(const Points& points, const SideChoice& choice);

}  // namespace relief
