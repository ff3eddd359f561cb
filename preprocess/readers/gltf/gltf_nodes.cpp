#include "preprocess/readers/gltf/gltf_nodes.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <utility>

namespace relief {
namespace {

glm::dmat4 transform_of(const tinygltf::Node& node) {
  glm::dmat4 matrix(1.0);
  if (node.matrix.size() == 16) {
    for (glm::length_t k = 0; k < 16; ++k)
      matrix[k / 4][k % 4] = node.matrix[static_cast<std::size_t>(k)];
    return matrix;
  }
  if (node.translation.size() == 3)
    matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  if (node.rotation.size() == 4) {
    matrix = matrix * glm::mat4_cast(glm::normalize(glm::dquat(
                          node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])));
  }
  if (node.scale.size() == 3) {
    for (glm::length_t c = 0; c < 3; ++c) matrix[c] *= node.scale[static_cast<std::size_t>(c)];
  }
  return matrix;
}

/// The nodes of the default scene; without scenes, those that are not children.
Result<std::vector<int>> root_nodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) return make_error("there is no scene {}", scene);
    return model.scenes[scene].nodes;
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<int> roots;
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (!is_child[n]) roots.push_back(static_cast<int>(n));
  }
  return roots;
}

}  // namespace

Result<std::vector<MeshInstance>> mesh_instances(const tinygltf::Model& model) {
  RELIEF_TRY_ASSIGN(const auto roots, root_nodes(model));
  std::vector<std::pair<int, glm::dmat4>> to_do;
  to_do.reserve(roots.size());
  for (const int node : roots) to_do.emplace_back(node, glm::dmat4(1.0));
  std::vector<bool> seen(model.nodes.size(), false);
  std::vector<MeshInstance> meshes;
  while (!to_do.empty()) {
    const auto [index, parent] = to_do.back();
    to_do.pop_back();
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size())
      return make_error("there is no node {}", index);
    if (seen[static_cast<std::size_t>(index)])
      return make_error("node {} has several parents, or is its own", index);
    seen[static_cast<std::size_t>(index)] = true;
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    const glm::dmat4 to_world = parent * transform_of(node);
    if (node.mesh >= 0) meshes.push_back({node.mesh, to_world});
    for (const int child : node.children) to_do.emplace_back(child, to_world);
  }
  return meshes;
}

}  // namespace relief
