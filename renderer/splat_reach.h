// How far every splat of a patch extends.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "renderer/padded_heights.h"
#include "renderer/splat_slopes.h"

namespace relief {

/// How far splats extend over the base plane toward -x, +x, -y and +y, in cells, by padded index.
/// `height_step`: cells per height index.
///
/// Between two neighbours each splat ends where their tangent planes meet: half-way on even ground,
/// but at the crest itself where one side is flat and the other steep; a splat that went half-way
/// there would stick out as a spike. Where the places in neighbouring rows leave a pinhole between
/// the four rectangles of a cell, the one that rises least on the way closes it. What the planes
/// still part by where they should meet, g, is closed by a margin: a view ray that rises by an
/// angle of at least a over the surface can't pass between two planes that both reach m >= g / (2
/// tan a) beyond that place. It is for a = 30 degrees and has a limit (docs/decisions.md).
///
/// Toward a hole a splat extends half a spacing along its slope.
[[nodiscard]] std::vector<glm::vec4> find_reaches(const PaddedHeights& heights,
                                                  const SplatSlopes& slopes, float height_step);

}  // namespace relief
