#include "common/seams/border_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "common/octahedral.h"

namespace relief {
namespace {

constexpr std::uint32_t kInside = std::numeric_limits<std::uint32_t>::max();

glm::dvec3 node_position(const Patch& patch, std::uint32_t node) {
  return position_of(patch, node % patch.width, node / patch.width);
}

glm::dvec3 normal_of(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  if (patch.normals.empty()) return patch.axes[2];
  return patch.axes * glm::dvec3(unit_from_snorm16(texel_at(patch.normals, i, j)));
}

/// Fits a plane to the samples within `reach` cells of a vertex, which at a border are few and on
/// one side of it. Returns false if they are too few or in one row.
bool find_plane_within(std::uint32_t reach, const Patch& patch, BorderVertex& vertex) {
  const std::uint32_t i = vertex.node % patch.width;
  const std::uint32_t j = vertex.node / patch.width;
  constexpr int kFewest = 6;
  const double scale = patch.height_step / patch.spacing;
  const std::int32_t base = patch.at(i, j);
  int count = 0;
  glm::dvec3 sum(0.0);
  glm::dmat3 products(0.0);  // of u, v and the height, in cells
  for (std::uint32_t y = j - std::min(j, reach); y <= std::min(j + reach, patch.height - 1); ++y) {
    for (std::uint32_t x = i - std::min(i, reach); x <= std::min(i + reach, patch.width - 1); ++x) {
      if (patch.at(x, y) == kHole) continue;
      const glm::dvec3 p(static_cast<double>(x) - i, static_cast<double>(y) - j,
                         (patch.at(x, y) - base) * scale);
      const double steps = std::abs(p.x) + std::abs(p.y);
      if (std::abs(p.z) > kSteepestJoined * steps) continue;  // of another sheet
      sum += p;
      products += glm::outerProduct(p, p);
      ++count;
    }
  }
  if (count < kFewest) return false;
  const double n = count;
  const glm::dmat3 c = products - glm::outerProduct(sum, sum) / n;
  const double determinant = c[0][0] * c[1][1] - c[0][1] * c[0][1];
  if (!(determinant > 0.25 * n)) return false;
  const double u = (c[2][0] * c[1][1] - c[2][1] * c[0][1]) / determinant;
  const double v = (c[2][1] * c[0][0] - c[2][0] * c[0][1]) / determinant;
  const double squares = std::max(c[2][2] - u * c[2][0] - v * c[2][1], 0.0);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-u, -v, 1.0));
  // Samples 0, 1 and 2 cells along an arc of bend k are off a line by 0.24 k (rms).
  constexpr double kOffLine = 0.24;
  vertex.plane_normal = patch.axes * normal;
  vertex.bend = std::sqrt(squares / n) * normal.z / kOffLine;
  return true;
}

/// Fits a plane to the samples about a vertex: in the tip of a face, which has few, farther off.
void find_plane(const Patch& patch, BorderVertex& vertex) {
  constexpr std::uint32_t kReach = 2;
  constexpr std::uint32_t kReachInTips = 4;
  vertex.plane_normal = patch.axes[2];
  if (!find_plane_within(kReach, patch, vertex)) find_plane_within(kReachInTips, patch, vertex);
}

bool is_beside_hole(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  if (i == 0 || j == 0 || i + 1 >= patch.width || j + 1 >= patch.height) return true;
  for (std::uint32_t y = j - 1; y <= j + 1; ++y) {
    for (std::uint32_t x = i - 1; x <= i + 1; ++x) {
      if (patch.at(x, y) == kHole) return true;
    }
  }
  return false;
}

/// Adds the border vertices of a patch and returns for each node which it has become.
std::vector<std::uint32_t> add_vertices(const Patch& patch, std::uint32_t id,
                                        const CellTriangles& cells, BorderMesh& mesh) {
  std::vector<std::uint32_t> numbers(patch.heights.size(), kInside);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      // i - 1 and j - 1 of the first wrap around to what is outside.
      if (patch.at(i, j) == kHole || is_surrounded(cells, i, j)) continue;
      const std::uint32_t node = j * patch.width + i;
      numbers[node] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({.position = position_of(patch, i, j),
                               .normal = normal_of(patch, i, j),
                               .spacing = patch.spacing,
                               .patch = id,
                               .node = node,
                               .beside_hole = is_beside_hole(patch, i, j)});
    }
  }
  return numbers;
}

void add_edges(const Patch& patch, const CellTriangles& cells,
               const std::vector<std::uint32_t>& numbers, BorderMesh& mesh) {
  const auto add_triangle = [&](const std::array<std::uint32_t, 3>& corners) {
    const glm::dvec3 a = node_position(patch, corners[0]);
    const glm::dvec3 normal = glm::normalize(
        glm::cross(node_position(patch, corners[1]) - a, node_position(patch, corners[2]) - a));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = numbers[corners[c]];
      const std::uint32_t to = numbers[corners[(c + 1) % 3]];
      if (from != kInside && to != kInside) mesh.edges.push_back({from, to, normal});
    }
  };
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      const std::uint32_t node = j * patch.width + i;
      const bool inside = numbers[node] == kInside && numbers[node + 1] == kInside &&
                          numbers[node + patch.width] == kInside &&
                          numbers[node + patch.width + 1] == kInside;
      if (!inside) for_each_triangle(patch, cells, i, j, add_triangle);
    }
  }
}

}  // namespace

BorderMesh find_borders(std::span<const Patch> patches, std::span<const CellTriangles> cells) {
  std::vector<BorderMesh> of_patches(patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    BorderMesh& own = of_patches[p];
    const auto numbers = add_vertices(patches[p], static_cast<std::uint32_t>(p), cells[p], own);
    add_edges(patches[p], cells[p], numbers, own);
  });
  BorderMesh mesh;
  std::size_t vertices = 0;
  std::size_t edges = 0;
  for (const BorderMesh& own : of_patches) {
    vertices += own.vertices.size();
    edges += own.edges.size();
  }
  mesh.vertices.reserve(vertices);
  mesh.edges.reserve(edges);
  for (const BorderMesh& own : of_patches) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), own.vertices.begin(), own.vertices.end());
    for (const BorderEdge& edge : own.edges)
      mesh.edges.push_back({first + edge.from, first + edge.to, edge.normal});
  }
  return mesh;
}

void find_planes(std::span<const Patch> patches, BorderMesh& mesh) {
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t v) {
    find_plane(patches[mesh.vertices[v].patch], mesh.vertices[v]);
  });
}

}  // namespace relief
