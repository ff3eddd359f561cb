// Meshes of designed parts: whose triangles, not their points, say where edges are.
#pragma once

#include "common/points.h"

namespace relief {

/// Whether the creases of a mesh are the edges of a part: lines, along which two creases meet in
/// each point. Those of scans, of noise and of simplified bodies end and branch everywhere. Points
/// that are repeated for their normals count once. False for more than 200,000 triangles, whose
/// spacing is too small for creases to matter much, and which would take long.
[[nodiscard]] bool is_sharp_mesh(const Points& mesh);

/// Whether a mesh is to be taken from its triangles: it is coarse (is_coarse_mesh) or sharp.
[[nodiscard]] bool is_designed_mesh(const Points& mesh);

}  // namespace relief
