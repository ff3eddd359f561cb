// Levels of detail: coarser grids of a patch, and which of them a view draws.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/patch.h"
#include "renderer/view/view.h"

namespace relief {

/// Level l has every 2^l-th node of a patch along each side; level 0 is the patch itself.
inline constexpr std::uint32_t kMaxLevels = 8;

/// What choosing a level needs to know of a patch. World frame, in double precision.
struct PatchExtent {
  glm::dvec3 centre{0.0};  ///< of a sphere about its samples
  double radius = 0.0;
  double spacing = 1.0;
  std::uint32_t levels = 1;    ///< that it has: none is coarser than the patch is wide
  std::uint32_t measured = 0;  ///< the coarsest level whose error is known
  /// By level, those measured: level_error, world units.
  std::array<double, kMaxLevels> errors{};
};

/// Returns how far a patch's samples lie from the cells of a level from 1 on, along the normal of
/// its plane: the root mean square, world units. None if no cell has all four corners.
[[nodiscard]] std::optional<double> level_error(const Patch& patch, std::uint32_t level);

/// Measures the levels up to one, but for those that are known. One without cells is taken to be
/// off by four times as much as the one before it, as on a curved surface; the first by a spacing.
/// `extent`: of the patch, in the model's frame.
void measure_levels(const Patch& patch, std::uint32_t coarsest, PatchExtent& extent);

[[nodiscard]] PatchExtent extent_of(const Patch& patch);

/// A level is off the samples by at most this share of `View::pixels_per_sample`: with 4 pixels by
/// 1/32 of a pixel. Silhouettes show it: one of 1/10 of a pixel costs the Dragon 2.5 dB.
inline constexpr double kMostLevelError = 1.0 / 128.0;

/// The coarsest level whose spacing, where the patch may be nearest to the eye, is at most
/// `view.pixels_per_sample` pixels; 0 if none is or the view asks for the finest (0 pixels).
[[nodiscard]] std::uint32_t coarsest_level(const View& view, const PatchExtent& extent);

/// The coarsest of those whose error, if it is known, is at most kMostLevelError of that, too.
[[nodiscard]] std::uint32_t choose_level(const View& view, const PatchExtent& extent);

/// The levels that any of the views chooses, finest first; level 0 without views.
[[nodiscard]] std::vector<std::uint32_t> levels_in(std::span<const View> views,
                                                   const PatchExtent& extent);

/// A coarser level of a patch.
struct PatchLevel {
  /// Its heights, and the normals at its nodes if the patch has any; no colours. Node (1, 1) is the
  /// patch's first. The origin may lie lower along the plane's normal.
  Patch grid;
  /// Of each node, row by row: 1 if all nodes of the patch in the cell right above it are samples.
  std::vector<std::uint8_t> whole;
};

/// Makes a level from 1 on. Its nodes take the height of the sample that they lie on. Where there
/// is none, but one no more than a coarse cell away along both sides, they continue the slope
/// there: so each cell that a sample touches is there, and the patch's mask, which fragments of
/// cells that are not whole look up, cuts off what is too much. A level thus covers what the patch
/// covers, and levels side by side close as patches do.
[[nodiscard]] PatchLevel coarsen(const Patch& patch, std::uint32_t level);

}  // namespace relief
