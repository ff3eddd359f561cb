// How textures lie on surfels.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/surfels/surfels.h"

namespace relief {

/// The gradients of the texture coordinates over the surfels: at offset (x, y) along the axes of
/// its frame, world units, a surfel has the coordinates texcoord + gradient * (x, y). Least squares
/// over the neighbours on its chart, which are those whose coordinates agree with one affine map:
/// neighbours beyond a seam are left out. 0, so that the surfel has one colour, where fewer than
/// three neighbours agree. Coordinates that are not finite have no gradient.
///
/// All spans are as long as `positions`, which are finite. The result does not depend on the number
/// of threads. Fails only if it is interrupted.
Result<std::vector<glm::mat2>> find_texture_gradients(std::span<const glm::dvec3> positions,
                                                      std::span<const glm::vec2> texcoords,
                                                      std::span<const SurfelFrame> frames,
                                                      std::span<const double> radii,
                                                      Progress& progress);

}  // namespace relief
