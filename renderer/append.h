// The meshes and points of a scene, moved to where they stand, as one.
#pragma once

#include <vector>

#include "common/transform.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Moves a mesh or points: p becomes translation + scale * (rotation * p), normals turn, radii
/// scale.
void transform(TriangleMesh& mesh, const Transform& transform);
void transform(SplatCloud& cloud, const Transform& transform);

/// The bodies of a mesh, also if it is a single one (then with the sphere about its box's middle).
[[nodiscard]] std::vector<MeshBody> bodies_of(const TriangleMesh& mesh);

/// Appends `from`. Where only one of them has colours the other's are the neutral grey, where only
/// one has grid coordinates, patches or materials the other's are 0. Patch ids are `patches_before`
/// higher. Fails, with a clause, if there are more vertices than 32 bits count.
Status append(TriangleMesh& to, TriangleMesh from, std::uint32_t patches_before);
void append(SplatCloud& to, SplatCloud from, std::uint32_t patches_before);

}  // namespace relief
