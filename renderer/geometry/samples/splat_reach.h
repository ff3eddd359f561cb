// How far every splat of a patch extends.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "renderer/geometry/samples/padded_heights.h"
#include "renderer/geometry/samples/splat_slopes.h"

namespace relief {

/// How far a splat extends over the base plane toward -x, +x, -y and +y, in cells.
struct SplatReach {
  glm::vec4 reach{0.0F};
  glm::vec4 gap{0.0F};  ///< height by which its plane and the next ones part there; 0 at a hole
};

/// Spacings that splats extend toward a hole: half-way to where the next sample would be.
inline constexpr float kReachToHole = 0.5F;
/// The same of patches that meet: most of their borders are less than twice as far apart. The
/// Dragon, quads, one view: 37.9 dB and no hole; 36.3 dB and 18 hole pixels at 0.5, 37.5 dB at 1.
inline constexpr float kReachToSeam = 0.8F;

/// The reaches of a patch's splats, by padded index. `height_step`: cells per height index.
///
/// Between two neighbours each splat ends where their tangent planes meet: half-way on even ground,
/// but at the crest itself where one side is flat and the other steep; a splat that went half-way
/// there would stick out as a spike. Where the positions in neighbouring rows leave a pinhole
/// between the four rectangles of a cell, the one that rises least on the way closes it.
///
/// What the planes still part by where they should meet, the gap, a margin must close: a view ray
/// that approaches both planes by v per cell can't pass between two that both reach gap / (2 v)
/// beyond that position. The vertex stage adds it for its view (splats.glsl: margins_of).
///
/// Toward a hole a splat extends `to_hole` spacings along its slope.
[[nodiscard]] std::vector<SplatReach> find_reaches(const PaddedHeights& heights,
                                                   const SplatSlopes& slopes, float height_step,
                                                   float to_hole);

/// The margin (cells) that closes a gap for rays that rise by 30 degrees or more over the surface:
/// that of splats whose margins are the same in all views. `cosine`: of the splat's tilt.
[[nodiscard]] float fixed_margin(float gap, float cosine);

}  // namespace relief
