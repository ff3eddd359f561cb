// Meshes that stand for models seen from afar, on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/geometry/proxy/proxy.h"
#include "renderer/geometry/proxy/proxy_levels.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/store_limits.h"
#include "shaders/include/shared.h"

namespace relief {

/// A level of a mesh on the GPU.
struct StoredProxyLevel {
  std::uint32_t first_vertex = 0;  ///< in ProxyStore::vertices
  std::uint32_t first_index = 0;   ///< in ProxyStore::indices
  std::uint32_t indices = 0;
};

/// A run of patches as meshes. They are in a frame of whole numbers: what is at p there is at
/// origin + unit * p in the model's.
struct StoredProxyMesh {
  glm::dvec3 origin{0.0};
  double unit = 1.0;
  std::vector<StoredProxyLevel> levels;  ///< finest first
};

struct ProxyStore {
  std::vector<StoredProxyMesh> meshes;
  Table vertices;                ///< shared::ProxyVertex
  std::optional<Table> sources;  ///< shared::ProxySource, where an image shows patches or uv
  Buffer indices;                ///< 32 bits each, counted from the level's first vertex
  Buffer patches;                ///< by instance: the per-instance attribute that names its frame
  VertexArray attributes;        ///< these two
};

/// Collects the meshes of runs of patches and their instances, and uploads them.
class ProxyUpload {
 public:
  explicit ProxyUpload(const StoreLimits& limits) : most_vertices_(limits.most_buffer_texels) {}

  /// Adds the levels of a run; returns its number. Fails if OpenGL lets no shader see as many
  /// vertices.
  Result<std::uint32_t> add(std::span<const Patch> patches, std::span<const JoinedPatches> joined,
                            const Proxy& model);

  /// Adds a instance whose frame is that patch of the store; returns its number.
  std::uint32_t add_instance(std::uint32_t patch);

  [[nodiscard]] const StoredProxyMesh& mesh(std::uint32_t number) const { return meshes_[number]; }
  [[nodiscard]] bool empty() const { return meshes_.empty(); }

  /// Uploads all that was added.
  ProxyStore take(const Gl& gl, bool with_sources);

 private:
  std::size_t most_vertices_;
  std::vector<StoredProxyMesh> meshes_;
  std::vector<shared::ProxyVertex> vertices_;
  std::vector<shared::ProxySource> sources_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> patches_;
};

}  // namespace relief
