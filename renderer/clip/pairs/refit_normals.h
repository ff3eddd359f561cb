// Normals that do not run smoothly over edges.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/pairs/disc_tree.h"

namespace relief {

/// Returns the normals of the discs of a tree, fitted anew to the neighbours on the same side of an
/// edge: bilateral means of the normals, repeated, so that a normal that leans over an edge joins
/// the side it is nearer to. Fails only if it is interrupted.
[[nodiscard]] Result<std::vector<glm::dvec3>> refit_normals(const DiscTree& tree,
                                                            Progress& progress);

}  // namespace relief
