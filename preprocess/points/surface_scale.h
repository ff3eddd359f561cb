// From how many neighbours on a scan looks like a surface.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace relief {

/// The numbers of nearest neighbours that are looked at.
inline constexpr std::array<std::uint32_t, 6> kSurfaceScales{8, 16, 32, 64, 128, 256};

/// Whether fewer neighbours than a surface takes may look like another surface.
enum class Strips {
  Real,   ///< no: flat neighbours are a surface, as the steps of a depth image are
  Noise,  ///< yes: the plane of a line and of its noise is flat, too
};

/// The scale of points whose neighbours are a line at all scales.
inline constexpr std::uint32_t kNoSurface = UINT32_MAX;

/// Returns the first of kSurfaceScales from which on a point's nearest neighbours spread in two
/// directions or three. Where points lie in lines, fewer are only a part of one line: of a scan
/// line, if a scanner's lines are far apart, or of a ray, if it was measured many times. With
/// Strips::Noise planes that more neighbours turn by more than 60 degrees are lines, too. Returns 0
/// if the neighbours spread at all scales, and kNoSurface if those of the last do not: of a cable,
/// or of lines that take more neighbours.
///
/// `offsets`: from the point to its neighbours, the nearest first, any unit.
[[nodiscard]] std::uint32_t first_surface_scale(std::span<const glm::dvec3> offsets, Strips strips);

/// Whether a point's nearest neighbours lie as in a square grid: four equally far away.
[[nodiscard]] bool lies_in_grid(std::span<const glm::dvec3> offsets);

}  // namespace relief
