// What of a volume a camera is to frame.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/volume/scalar_volume.h"
#include "common/volume/transfer_function.h"

namespace relief {

/// Nodes (world) whose convex hull holds all nodes that one of the functions shows, or that lie
/// beside a surface of one of the values `isos`: the first and the last of each row along i. Empty
/// if there is none, and for placements whose rows are not straight.
[[nodiscard]] std::vector<glm::dvec3> seen_nodes(const ScalarVolume& volume,
                                                 std::span<const TransferFunction> functions,
                                                 std::span<const double> isos);

}  // namespace relief
