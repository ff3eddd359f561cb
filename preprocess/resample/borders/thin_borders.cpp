#include "preprocess/resample/borders/thin_borders.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "common/seams/border_mesh.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/vertex_grid.h"

namespace relief {
namespace {

// Samples of two patches nearer than this, in spacings, make slivers.
constexpr double kNearInSpacings = 0.45;

}  // namespace

void thin_borders(std::span<Patch> patches) {
  const BorderMesh borders = find_borders(patches, cell_triangles(std::span<const Patch>(patches)));
  const std::vector<BorderVertex>& vertices = borders.vertices;
  const VertexGrid lookup(vertices);
  std::vector<double> faces;
  faces.reserve(vertices.size());
  for (const BorderVertex& vertex : vertices)
    faces.push_back(glm::dot(patches[vertex.patch].axes[2], vertex.normal));
  std::vector<std::uint32_t> askew_last(vertices.size());
  std::iota(askew_last.begin(), askew_last.end(), 0U);
  std::stable_sort(askew_last.begin(), askew_last.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return faces[a] > faces[b]; });
  std::vector<std::uint8_t> kept(vertices.size(), 0);
  for (const std::uint32_t v : askew_last) {
    const BorderVertex& vertex = vertices[v];
    kept[v] = 1;
    lookup.for_each_within(vertex.position, kNearInSpacings * vertex.spacing,
                           [&](const VertexGrid::Place& place, double) {
                             const std::uint32_t w = place.vertex;
                             const BorderVertex& other = vertices[w];
                             if (other.patch == vertex.patch || kept[w] == 0) return;
                             if (glm::dot(other.normal, vertex.normal) > 0.0) kept[v] = 0;
                           });
    if (kept[v] == 0) patches[vertex.patch].heights[vertex.node] = kHole;
  }
}

}  // namespace relief
