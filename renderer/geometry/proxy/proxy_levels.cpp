#include "renderer/geometry/proxy/proxy_levels.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "common/image/srgb.h"
#include "common/octahedral.h"
#include "common/seams/cell_triangles.h"
#include "renderer/geometry/node_texels.h"
#include "renderer/geometry/patch_normals.h"
#include "renderer/geometry/proxy/proxy_clusters.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Notes a triangle unless two of its corners have become one; the least corner comes first.
void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::vector<Triangle>& triangles) {
  if (a == b || b == c || c == a) return;
  if (b < a && b < c) {
    triangles.push_back({b, c, a});
  } else if (c < a && c < b) {
    triangles.push_back({c, a, b});
  } else {
    triangles.push_back({a, b, c});
  }
}

/// Each triangle once.
void keep_unique(std::vector<Triangle>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

/// The mean of `value` over the texels that are nearer to a node than to any other.
template <class Texel, class Value>
glm::vec3 mean_at(const AttributeMap<Texel>& map, std::uint32_t i, std::uint32_t j,
                  const Value& value) {
  const TexelSum texels = sum_about_node(map, i, j, value);
  return texels.sum / texels.count;
}

/// Adds a patch's samples to the grid; of each node the cluster that it is in, or kNoMaterial for a
/// hole.
std::vector<std::uint32_t> add_samples(const Patch& patch, std::uint32_t number, glm::dvec3 middle,
                                       CubeGrid& grid) {
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  const glm::mat3 axes(patch.axes);
  std::vector<std::uint32_t> clusters(patch.heights.size(), kNoMaterial);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::vec3 normal = mean_at(normals, i, j, unit_from_snorm16);
      const glm::vec3 colour = patch.colours.empty()
                                   ? glm::vec3(shared::kNeutralGrey)
                                   : mean_at(patch.colours, i, j, [](glm::u8vec3 texel) {
                                       return linear_from_srgb8(texel);
                                     });
      Cluster sample;
      sample.sum = {position_of(patch, i, j) - middle, axes * normal, colour, number,
                    glm::vec2(i, j)};
      // A file from strangers may have texels that cancel.
      const double length = glm::length(normal);
      const glm::dvec3 n =
          length > 0.0 ? patch.axes * (glm::dvec3(normal) / length) : patch.axes[2];
      sample.normals = glm::outerProduct(n, n);
      sample.offsets = glm::dot(n, sample.sum.position) * n;
      sample.count = 1.0;
      clusters[std::size_t{j} * patch.width + i] = grid.add(sample);
    }
  }
  return clusters;
}

/// What is left of the triangles of the cells of a patch that overlaps others.
void add_cells(const Patch& patch, const std::vector<std::uint32_t>& clusters,
               std::vector<Triangle>& triangles) {
  for (std::uint32_t j = 0; j + 1 < patch.height; ++j) {
    for (std::uint32_t i = 0; i + 1 < patch.width; ++i) {
      const std::size_t node = std::size_t{j} * patch.width + i;
      const std::uint32_t a = clusters[node];
      const std::uint32_t b = clusters[node + 1];
      const std::uint32_t c = clusters[node + patch.width];
      const std::uint32_t d = clusters[node + patch.width + 1];
      if (a == kNoMaterial || b == kNoMaterial || c == kNoMaterial || d == kNoMaterial) continue;
      add_triangle(a, b, d, triangles);
      add_triangle(a, d, c, triangles);
    }
  }
}

/// The same of a patch that meets others.
void add_joined_cells(const Patch& patch, const std::vector<std::uint32_t>& clusters,
                      std::vector<Triangle>& triangles) {
  const CellTriangles cells = cell_triangles(patch);
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      if (cells.at(i, j) != kWholeCell) continue;
      for_each_triangle(patch, cells, i, j, [&](const Triangle& t) {
        add_triangle(clusters[t[0]], clusters[t[1]], clusters[t[2]], triangles);
      });
    }
  }
}

/// What is left of seams. A seam vertex becomes part of the cluster of a sample beside it, the same
/// for all patches that share it: so nothing opens. `clusters`: by patch that meets others.
void add_seams(const Seams& seams, std::span<const std::vector<std::uint32_t>> clusters,
               std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> of_vertex(seams.vertices.size(), kNoMaterial);
  const auto is_vertex = [](std::uint32_t corner) { return (corner & kSeamVertexBit) != 0; };
  for (std::size_t p = 0; p < seams.triangles.size(); ++p) {
    for (const Triangle& t : seams.triangles[p]) {
      const auto* const node = std::find_if_not(t.begin(), t.end(), is_vertex);
      if (node == t.end()) continue;
      for (const std::uint32_t corner : t) {
        if (!is_vertex(corner)) continue;
        std::uint32_t& cluster = of_vertex[corner & ~kSeamVertexBit];
        if (cluster == kNoMaterial) cluster = clusters[p][*node];
      }
    }
  }
  for (std::size_t p = 0; p < seams.triangles.size(); ++p) {
    const auto cluster_of = [&](std::uint32_t corner) {
      return is_vertex(corner) ? of_vertex[corner & ~kSeamVertexBit] : clusters[p][corner];
    };
    for (const Triangle& t : seams.triangles[p])
      add_triangle(cluster_of(t[0]), cluster_of(t[1]), cluster_of(t[2]), triangles);
  }
}

ProxyLevel make_level(double spacing, glm::dvec3 middle, const CubeGrid& grid,
                      const std::vector<Triangle>& triangles) {
  ProxyLevel level{spacing, {}, triangles};
  level.vertices.reserve(grid.clusters().size());
  for (const Cluster& cluster : grid.clusters()) {
    ProxyVertex vertex = cluster.sum;
    vertex.position = middle + position_of(cluster, spacing);
    vertex.normal /= static_cast<float>(cluster.count);
    vertex.colour /= static_cast<float>(cluster.count);
    level.vertices.push_back(vertex);
  }
  return level;
}

}  // namespace

std::vector<ProxyLevel> make_proxy_levels(std::span<const Patch> patches,
                                          std::span<const JoinedPatches> joined,
                                          const Proxy& model) {
  std::vector<ProxyLevel> levels;
  if (model.spacings.empty()) return levels;
  const glm::dvec3 middle = model.sphere.centre;
  const std::span<const double> spacings(model.spacings);
  CubeGrid grid(spacings.front());
  std::vector<Triangle> triangles;
  std::vector<std::vector<std::uint32_t>> clusters;
  for (std::uint32_t p = 0; p < patches.size(); ++p)
    clusters.push_back(add_samples(patches[p], p, middle, grid));
  std::vector<bool> is_joined(patches.size(), false);
  for (const JoinedPatches& some : joined) {
    const std::size_t count = some.seams->triangles.size();
    std::fill_n(is_joined.begin() + some.first, count, true);
    add_seams(*some.seams, std::span(clusters).subspan(some.first, count), triangles);
  }
  std::vector<Triangle> of_patch;  // many samples have one cluster, and then one triangle
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    of_patch.clear();
    (is_joined[p] ? add_joined_cells : add_cells)(patches[p], clusters[p], of_patch);
    keep_unique(of_patch);
    triangles.insert(triangles.end(), of_patch.begin(), of_patch.end());
  }
  keep_unique(triangles);
  levels.push_back(make_level(spacings.front(), middle, grid, triangles));
  for (const double spacing : spacings.subspan(1)) {
    CubeGrid coarser(spacing);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(grid.clusters().size());
    for (const Cluster& cluster : grid.clusters()) numbers.push_back(coarser.add(cluster));
    const std::vector<Triangle> finer = std::exchange(triangles, {});
    for (const Triangle& t : finer)
      add_triangle(numbers[t[0]], numbers[t[1]], numbers[t[2]], triangles);
    keep_unique(triangles);
    grid = std::move(coarser);
    levels.push_back(make_level(spacing, middle, grid, triangles));
  }
  return levels;
}

}  // namespace relief
