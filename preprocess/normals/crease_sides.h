// The sides of a crease: groups of points whose normals agree, on both sides of a sharp turn.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace relief {

struct OrientedPoint {
  glm::dvec3 position{0.0};
  glm::vec3 normal{0.0F};  ///< unit
};

/// What points on one side of a crease have in common.
struct CreaseSide {
  glm::dvec3 middle{0.0};
  glm::vec3 normal{0.0F};  ///< unit
};

/// Normals this near to that of a side belong to it: 25 degrees. Points on the crease itself have a
/// mean of both sides' normals, and tell of neither.
inline constexpr float kCreaseSideCosine = 0.906F;
/// Sides that turn by less than 35 degrees make no crease.
inline constexpr float kCreaseTurnCosine = 0.82F;
/// Where no normal turns by more than this, 20 degrees, there is none to be looked for.
inline constexpr float kSlightTurnCosine = 0.94F;
/// The side that is looked for first shows in as many points.
inline constexpr std::size_t kFewestOfNearSide = 4;

/// The side that most of some points show: the mean of those whose normals agree with the one that
/// most agree with. Nothing if those are fewer than `fewest` or vary by more than 7 degrees (rms),
/// as they do on a round feature.
[[nodiscard]] std::optional<CreaseSide> most_shown_side(std::span<const OrientedPoint> points,
                                                        std::size_t fewest);

/// Of the sides that some points show, each by three at least, the one that turns farthest from
/// `normal`: those on the crease lie between both.
[[nodiscard]] std::optional<CreaseSide> farthest_side(std::span<const OrientedPoint> points,
                                                      glm::vec3 normal);

}  // namespace relief
