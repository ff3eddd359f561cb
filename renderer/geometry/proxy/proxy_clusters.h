// Samples of patches that are near each other and face the same way, for proxies.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "common/instance.h"
#include "common/points.h"
#include "renderer/geometry/proxy/proxy_vertex.h"

namespace relief {

/// A cube of the grid.
struct ProxyCube {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;

  bool operator==(const ProxyCube&) const = default;
};

struct ProxyCubeHash {
  std::size_t operator()(const ProxyCube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t value : {cube.x, cube.y, cube.z}) {
      hash = (hash ^ static_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

/// Samples that become one vertex: their sums, positions from the middle of the model, and how far
/// from the middle of their cube the one is whose position the vertex has.
struct Cluster {
  ProxyVertex sum;
  glm::dmat3 normals{0.0};  ///< n n^T
  glm::dvec3 offsets{0.0};  ///< (n . p) n
  double count = 0.0;
  double away = 0.0;                 ///< in cubes
  std::uint32_t next = kNoMaterial;  ///< the next one of the cube
};

/// Collects samples, or the clusters of a finer level, into cubes of a grid.
class CubeGrid {
 public:
  explicit CubeGrid(double spacing) : spacing_(spacing) {}

  /// The number of the cluster that this one goes into.
  std::uint32_t add(const Cluster& finer);

  [[nodiscard]] const std::vector<Cluster>& clusters() const { return clusters_; }

 private:
  /// The cluster of the cube that faces the same way; a new one if there is none.
  std::uint32_t find(glm::dvec3 low, const Cluster& finer);

  double spacing_;
  std::unordered_map<ProxyCube, std::uint32_t, ProxyCubeHash> firsts_;
  std::vector<Cluster> clusters_;
};

/// Where the tangent planes of the samples come nearest to meeting (Lindstrom 2000, "Out-of-core
/// simplification of large polygonal models"): their mean would cut off what is narrower than a
/// cube.
[[nodiscard]] glm::dvec3 position_of(const Cluster& cluster, double spacing);

}  // namespace relief
