// The tangents that a glTF file gives. Not a public header: it needs tinygltf.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "preprocess/readers/gltf/gltf_accessor.h"

namespace relief {

/// The first `count` tangents of an accessor in the world, as CornerTangents have them, but by
/// point; fewer if it has fewer. A node that mirrors turns their handedness round. Errors are
/// clauses.
Result<std::vector<glm::vec4>> read_tangents(const tinygltf::Model& model, int accessor,
                                             std::size_t count, const glm::dmat4& placed);

/// The same by triangle; corners that are no points have none.
[[nodiscard]] std::vector<CornerTangents> by_corner(const std::vector<glm::vec4>& tangents,
                                                    const std::vector<Triangle>& triangles);

}  // namespace relief
