// Reads the tangents of a glTF file. Not a public header: it needs tinygltf.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "preprocess/readers/gltf/gltf_accessor.h"

namespace relief {

/// Returns the first `count` tangents of an accessor in the world, one a point, in the form of
/// CornerTangents; fewer if the accessor has fewer. A mirroring node flips their handedness. Errors
/// are clauses.
Result<std::vector<glm::vec4>> read_tangents(const tinygltf::Model& model, int accessor,
                                             std::size_t count, const glm::dmat4& to_world);

/// Returns the tangents of points by triangle corner; 0 for corners with invalid indices.
[[nodiscard]] std::vector<CornerTangents> by_corner(const std::vector<glm::vec4>& tangents,
                                                    const std::vector<Triangle>& triangles);

}  // namespace relief
