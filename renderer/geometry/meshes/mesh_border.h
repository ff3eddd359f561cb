// The borders of patches that overlap in a mesh of them.
#pragma once

#include <cstdint>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief {

/// Adds what patch `id` covers of the cells that holes cut (PatchBorder), set back as far as
/// `onepass` does. `vertices`: add_vertices()'s.
void add_border(const Patch& patch, std::uint32_t id, bool coloured,
                const std::vector<std::uint32_t>& vertices, TriangleMesh& mesh);

}  // namespace relief
