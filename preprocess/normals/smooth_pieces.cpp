#include "preprocess/normals/smooth_pieces.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "preprocess/normals/signed_forest.h"

namespace relief {
namespace {

// Pairs of this many neighbours connect any reasonable sampling; more only cost sorting.
constexpr std::uint32_t kPairedNeighbours = 10;
// Pairs that cost more are not sure: normals 25 degrees apart, or a pair that leaves the surface by
// as much.
constexpr float kSureCost = 0.3F;

/// Hoppe's cost 1 - |n_a . n_b|, plus a term that keeps pairs on the surface: a pair that leaves
/// along the normals joins the two sides of a thin sheet, whose normals are parallel too.
float cost_of(const std::vector<glm::dvec3>& positions, const std::vector<glm::vec3>& normals,
              std::uint32_t a, std::uint32_t b) {
  const glm::vec3 along(glm::normalize(positions[b] - positions[a]));
  return 1.0F - std::abs(glm::dot(normals[a], normals[b])) +
         0.5F * (std::abs(glm::dot(along, normals[a])) + std::abs(glm::dot(along, normals[b])));
}

struct Pair {
  float cost;
  std::uint32_t a;
  std::uint32_t b;

  bool operator<(const Pair& o) const {
    if (cost != o.cost) return cost < o.cost;
    return a != o.a ? a < o.a : b < o.b;
  }
};

std::vector<Pair> collect_pairs(const std::vector<glm::dvec3>& positions,
                                const NeighbourGraph& graph,
                                const std::vector<glm::vec3>& normals) {
  const std::uint32_t k = std::min(kPairedNeighbours, graph.k);
  std::vector<Pair> pairs(positions.size() * k);
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    for (std::uint32_t m = 0; m < k; ++m) {
      const auto a = static_cast<std::uint32_t>(i);
      const std::uint32_t b = graph.of(i)[m];
      pairs[i * k + m] = {cost_of(positions, normals, a, b), std::min(a, b), std::max(a, b)};
    }
  });
  return pairs;
}

}  // namespace

SmoothPieces cut_into_pieces(const std::vector<glm::dvec3>& positions, const NeighbourGraph& graph,
                             std::uint32_t most, std::vector<glm::vec3>& normals) {
  std::vector<Pair> pairs = collect_pairs(positions, graph, normals);
  std::erase_if(pairs, [](const Pair& pair) { return !(pair.cost < kSureCost); });
  tbb::parallel_sort(pairs.begin(), pairs.end());
  SignedForest forest(positions.size());
  for (const Pair& pair : pairs) {
    const SignedForest::Root a = forest.find(pair.a);
    const SignedForest::Root b = forest.find(pair.b);
    if (a.root == b.root || forest.size(a) + forest.size(b) > most) continue;
    forest.join(a, b, glm::dot(normals[pair.a], normals[pair.b]) < 0.0F);
  }
  constexpr auto kUnnumbered = static_cast<std::uint32_t>(-1);
  SmoothPieces pieces{std::vector<std::uint32_t>(positions.size()), 0};
  std::vector<std::uint32_t> number_of_root(positions.size(), kUnnumbered);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const SignedForest::Root root = forest.find(i);
    if (root.flipped) normals[i] = -normals[i];
    std::uint32_t& number = number_of_root[root.root];
    if (number == kUnnumbered) number = pieces.count++;
    pieces.of_point[i] = number;
  }
  return pieces;
}

std::vector<PieceLink> link_pieces(const std::vector<glm::dvec3>& positions,
                                   const NeighbourGraph& graph, const SmoothPieces& pieces,
                                   const std::vector<glm::vec3>& normals) {
  std::vector<PieceLink> votes;
  const std::uint32_t k = std::min(kPairedNeighbours, graph.k);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    for (const std::uint32_t j : graph.of(i).first(k)) {
      const std::uint32_t a = pieces.of_point[i];
      const std::uint32_t b = pieces.of_point[j];
      if (a == b) continue;
      // Half of the pairs are seen from both ends.
      const float sure = 0.5F * std::max(0.0F, 1.0F - cost_of(positions, normals, i, j));
      if (sure == 0.0F) continue;
      votes.push_back(
          {std::min(a, b), std::max(a, b), glm::dot(normals[i], normals[j]) < 0.0F ? -sure : sure});
    }
  }
  // Stable: the order of a sum of floats decides its last bits.
  std::ranges::stable_sort(votes, [](const PieceLink& x, const PieceLink& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  std::vector<PieceLink> links;
  for (const PieceLink& vote : votes) {
    if (!links.empty() && links.back().a == vote.a && links.back().b == vote.b)
      links.back().votes += vote.votes;
    else
      links.push_back(vote);
  }
  return links;
}

}  // namespace relief
