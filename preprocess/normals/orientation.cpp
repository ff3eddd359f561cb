// Consistent orientation by a minimum spanning forest (Hoppe et al. 1992, section 3.3).
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/normals/normals.h"
#include "preprocess/normals/signed_forest.h"

namespace relief {
namespace {

struct Edge {
  float cost;
  std::uint32_t a;
  std::uint32_t b;

  bool operator<(const Edge& o) const {
    if (cost != o.cost) return cost < o.cost;
    return a != o.a ? a < o.a : b < o.b;
  }
};

// Hoppe's cost 1 - |n_a . n_b|, plus a term that keeps the tree on the surface: an edge that leaves
// along the normals joins the two sides of a thin sheet, whose normals are parallel too.
float edge_cost(const Points& points, const std::vector<glm::vec3>& normals, std::uint32_t a,
                std::uint32_t b) {
  const glm::vec3 along(glm::normalize(points.positions[b] - points.positions[a]));
  return 1.0F - std::abs(glm::dot(normals[a], normals[b])) +
         0.5F * (std::abs(glm::dot(along, normals[a])) + std::abs(glm::dot(along, normals[b])));
}

// Edges to this many neighbours connect any reasonable sampling; more only cost sorting.
constexpr std::uint32_t kTreeNeighbours = 10;

std::vector<Edge> collect_edges(const Points& points, const NeighbourGraph& graph,
                                const std::vector<glm::vec3>& normals) {
  const std::uint32_t k = std::min(kTreeNeighbours, graph.k);
  std::vector<Edge> edges(points.size() * k);
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    for (std::uint32_t m = 0; m < k; ++m) {
      const auto a = static_cast<std::uint32_t>(i);
      const std::uint32_t b = graph.of(i)[m];
      edges[i * k + m] = {edge_cost(points, normals, a, b), std::min(a, b), std::max(a, b)};
    }
  });
  tbb::parallel_sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

Sheets orient_normals(const Points& points, const NeighbourGraph& graph,
                      std::vector<glm::vec3>& normals) {
  const std::size_t n = points.size();
  SignedForest forest(n);
  for (const Edge& edge : collect_edges(points, graph, normals)) {
    const SignedForest::Root a = forest.find(edge.a);
    const SignedForest::Root b = forest.find(edge.b);
    if (a.root == b.root) continue;
    forest.join(a, b, glm::dot(normals[edge.a], normals[edge.b]) < 0.0F);
  }

  constexpr auto kUnnumbered = static_cast<std::uint32_t>(-1);
  Sheets sheets{std::vector<std::uint32_t>(n), 0};
  std::vector<std::uint32_t> number_of_root(n, kUnnumbered);
  for (std::uint32_t i = 0; i < n; ++i) {
    const SignedForest::Root root = forest.find(i);
    if (root.flipped) normals[i] = -normals[i];
    std::uint32_t& number = number_of_root[root.root];
    if (number == kUnnumbered) number = sheets.count++;
    sheets.of_point[i] = number;
  }
  const std::vector<SheetSums> sums =
      sum_up(points, n, normals, graph.spacing, sheets, points.positions.front());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (faces_inward(sums[sheets.of_point[i]], points.viewpoint.has_value()))
      normals[i] = -normals[i];
  }
  return sheets;
}

}  // namespace relief
