// The meshes of a glTF file's scene. Not a public header: it needs tinygltf.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "common/error.h"
#include "preprocess/readers/gltf/gltf_accessor.h"

namespace relief {

/// A mesh and its transform.
struct MeshInstance {
  int mesh = 0;              ///< index as in the file, not checked
  glm::dmat4 to_world{1.0};  ///< from the mesh's coordinates
};

/// Returns the meshes of the default scene with the transforms of their nodes; without scenes,
/// those of all nodes. Indices of nodes are not trusted. Errors are clauses.
Result<std::vector<MeshInstance>> mesh_instances(const tinygltf::Model& model);

}  // namespace relief
