// Sides of normals that agree with the winding numbers that the surface itself has ([Lin 2024]).
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

#include "common/disjoint_sets.h"
#include "preprocess/normals/normals.h"
#include "preprocess/normals/side_energy.h"
#include "preprocess/normals/signed_forest.h"
#include "preprocess/normals/smooth_pieces.h"
#include "preprocess/normals/winding_numbers.h"

namespace relief {
namespace {

// Sides of this many pieces are chosen together: the matrix of all pairs has 6 MB, and the time,
// 0.1 to 0.3 s, does not grow with the scan. Twice and half as many made no scan better.
constexpr std::size_t kMostPieces = 1200;
// Pieces of fewer points are no surface yet: 64 are eight by eight. Pieces that stay smaller than a
// sixteenth of what is allowed are slivers between others and follow them.
constexpr std::size_t kFewestPoints = 64;
constexpr std::size_t kSliverShare = 16;
constexpr std::size_t kFewestSliverPoints = 8;
// Six places instead of three changed nothing.
constexpr std::size_t kPlacesPerPiece = 3;
// What a sure pair of neighbours counts, in areas of a point, beside an error of the winding number
// of one about one point. With 1, 3 % of the Bunny's ground is flipped (in its hidden part), with
// 0.5 also 3 % of dragon_vrip_res3 on a ground, with 0.25 5 to 16 % of all bodies on a ground.
constexpr float kPairWeight = 2.0F;
// Directions that are less along the normal don't tell its side: the surface is seen edge on.
constexpr float kSureCosine = 0.25F;

/// The surface of the largest pieces, whose sides are chosen together.
struct ChosenPieces {
  std::vector<std::uint32_t> pieces;  ///< by number of points, most first
  std::vector<std::uint32_t> node;    ///< of each piece: its place in `pieces`, or kNoNode
  PiecedSurface surface;

  static constexpr std::uint32_t kNoNode = UINT32_MAX;
};

ChosenPieces choose_pieces(const Points& points, const NeighbourGraph& graph,
                           const std::vector<glm::vec3>& normals, const SmoothPieces& all,
                           std::size_t fewest_points) {
  std::vector<std::uint32_t> first(all.count + 1, 0);
  for (const std::uint32_t piece : all.of_point) ++first[piece + 1];
  const auto size_of = [&first](std::uint32_t piece) { return first[piece + 1] - first[piece]; };
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> members(points.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t i = 0; i < points.size(); ++i) members[next[all.of_point[i]]++] = i;

  ChosenPieces chosen;
  for (std::uint32_t piece = 0; piece < all.count; ++piece)
    if (size_of(piece) >= fewest_points) chosen.pieces.push_back(piece);
  std::ranges::stable_sort(chosen.pieces, std::greater(), size_of);
  chosen.pieces.resize(std::min(chosen.pieces.size(), kMostPieces));
  chosen.node.assign(all.count, ChosenPieces::kNoNode);
  glm::dvec3 centre(0.0);
  for (const glm::dvec3& p : points.positions) centre += p / static_cast<double>(points.size());
  PiecedSurface& surface = chosen.surface;
  for (const std::uint32_t piece : chosen.pieces) {
    chosen.node[piece] = static_cast<std::uint32_t>(surface.first.size());
    surface.first.push_back(static_cast<std::uint32_t>(surface.positions.size()));
    for (std::uint32_t m = first[piece]; m < first[piece + 1]; ++m) {
      const std::uint32_t i = members[m];
      surface.positions.emplace_back(points.positions[i] - centre);
      surface.area_normals.push_back(graph.spacing[i] * graph.spacing[i] * normals[i]);
    }
  }
  surface.first.push_back(static_cast<std::uint32_t>(surface.positions.size()));
  return chosen;
}

/// How far the winding numbers about the surface are from a half, squared, over its area; as much
/// as depends on the sides.
void add_winding_numbers(const PiecedSurface& surface, SideEnergy& energy) {
  const SurfacePlaces places = places_on(surface, kPlacesPerPiece);
  Eigen::MatrixXf numbers = winding_numbers(surface, places);
  const Eigen::Map<const Eigen::VectorXf> areas(places.areas.data(),
                                                static_cast<Eigen::Index>(places.areas.size()));
  energy.fields += numbers.transpose() * areas;
  numbers = areas.cwiseSqrt().asDiagonal() * numbers;
  energy.pairs.selfadjointView<Eigen::Lower>().rankUpdate(numbers.transpose(), -2.0F);
  energy.pairs.triangularView<Eigen::StrictlyUpper>() = energy.pairs.transpose();
  energy.pairs.diagonal().setZero();
}

void add_links(const std::vector<PieceLink>& links, const ChosenPieces& chosen,
               SideEnergy& energy) {
  const float area_of_point =
      energy.areas.sum() / static_cast<float>(chosen.surface.positions.size());
  for (const PieceLink& link : links) {
    const std::uint32_t a = chosen.node[link.a];
    const std::uint32_t b = chosen.node[link.b];
    if (a == ChosenPieces::kNoNode || b == ChosenPieces::kNoNode) continue;
    const float gain = kPairWeight * area_of_point * link.votes;
    energy.pairs(a, b) += gain;
    energy.pairs(b, a) += gain;
  }
}

Eigen::VectorXf sides_of(const ChosenPieces& chosen, const std::vector<PieceLink>& links,
                         const std::vector<float>& towards, const KnownSides& known) {
  const auto count = static_cast<Eigen::Index>(chosen.pieces.size());
  const std::vector<float> areas = areas_of(chosen.surface);
  SideEnergy energy{Eigen::MatrixXf::Zero(count, count), Eigen::VectorXf(count),
                    Eigen::VectorXf(count)};
  for (Eigen::Index a = 0; a < count; ++a) {
    energy.areas[a] = std::max(areas[static_cast<std::size_t>(a)], 1e-30F);
    energy.fields[a] = known.weight * towards[chosen.pieces[static_cast<std::size_t>(a)]];
  }
  if (!known.is_sure) add_winding_numbers(chosen.surface, energy);
  add_links(links, chosen, energy);
  return choose_sides(energy);
}

std::vector<float> areas_of(const NeighbourGraph& graph, const SmoothPieces& pieces) {
  std::vector<float> areas(pieces.count, 0.0F);
  for (std::size_t i = 0; i < pieces.of_point.size(); ++i)
    areas[pieces.of_point[i]] += graph.spacing[i] * graph.spacing[i];
  return areas;
}

/// The area of each piece as the known direction sees it, world units squared; negative: from
/// behind.
std::vector<float> areas_towards(const Points& points, const NeighbourGraph& graph,
                                 const std::vector<glm::vec3>& normals, const SmoothPieces& pieces,
                                 const KnownSides& known) {
  std::vector<float> of_point(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    of_point[i] =
        graph.spacing[i] * graph.spacing[i] * glm::dot(normals[i], known.direction_at(points, i));
  });
  std::vector<float> towards(pieces.count, 0.0F);
  for (std::size_t i = 0; i < points.size(); ++i) towards[pieces.of_point[i]] += of_point[i];
  return towards;
}

/// Returns which pieces to flip: the chosen ones as chosen. Others face the known direction if it
/// leads slivers and they are not along it. Otherwise they follow along the links with the most
/// votes; pieces without a link to one of those face the known direction.
std::vector<std::uint8_t> turns_of(const ChosenPieces& chosen, const Eigen::VectorXf& sides,
                                   std::vector<PieceLink> links, const std::vector<float>& areas,
                                   const std::vector<float>& towards, const KnownSides& known) {
  const auto count = static_cast<std::uint32_t>(chosen.node.size());
  SignedForest forest(count + 1);
  const auto join = [&forest](std::uint32_t a, std::uint32_t b, bool flip) {
    const SignedForest::Root x = forest.find(a);
    const SignedForest::Root y = forest.find(b);
    if (x.root != y.root) forest.join(x, y, flip);
  };
  for (std::size_t a = 0; a < chosen.pieces.size(); ++a)
    join(count, chosen.pieces[a], sides[static_cast<Eigen::Index>(a)] < 0.0F);
  for (std::uint32_t piece = 0; piece < count; ++piece) {
    const bool is_led = known.leads_slivers && chosen.node[piece] == ChosenPieces::kNoNode &&
                        std::abs(towards[piece]) > kSureCosine * areas[piece];
    if (is_led) join(count, piece, towards[piece] < 0.0F);
  }
  std::ranges::stable_sort(links, std::greater(),
                           [](const PieceLink& link) { return std::abs(link.votes); });
  for (const PieceLink& link : links) join(link.a, link.b, link.votes < 0.0F);

  std::vector<float> of_root(count + 1, 0.0F);
  for (std::uint32_t piece = 0; piece < count; ++piece) {
    const SignedForest::Root root = forest.find(piece);
    of_root[root.root] += root.flipped ? -towards[piece] : towards[piece];
  }
  const SignedForest::Root outside = forest.find(count);
  std::vector<std::uint8_t> turns(count);
  for (std::uint32_t piece = 0; piece < count; ++piece) {
    const SignedForest::Root root = forest.find(piece);
    const bool root_is_turned =
        root.root == outside.root ? outside.flipped : of_root[root.root] < 0.0F;
    turns[piece] = root.flipped != root_is_turned ? 1 : 0;
  }
  return turns;
}

}  // namespace

void orient_normals(const Points& points, const NeighbourGraph& graph, const SideChoice& choice,
                    std::vector<glm::vec3>& normals, const Progress& progress) {
  const KnownSides known = known_sides(points, choice);
  // Pieces have about half as many points as they may.
  const std::size_t most = std::max(kFewestPoints, 2 * points.size() / kMostPieces);
  const SmoothPieces pieces =
      cut_into_pieces(points.positions, graph, static_cast<std::uint32_t>(most), normals);
  if (progress.cancelled()) return;
  const std::vector<PieceLink> links = link_pieces(points.positions, graph, pieces, normals);
  const std::vector<float> towards = areas_towards(points, graph, normals, pieces, known);
  const ChosenPieces chosen = choose_pieces(points, graph, normals, pieces,
                                            std::max(kFewestSliverPoints, most / kSliverShare));
  if (progress.cancelled()) return;
  const Eigen::VectorXf sides = sides_of(chosen, links, towards, known);
  const std::vector<std::uint8_t> turns =
      turns_of(chosen, sides, links, areas_of(graph, pieces), towards, known);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (turns[pieces.of_point[i]] != 0) normals[i] = -normals[i];
    if (!known.is_sure) continue;
    const float cosine = glm::dot(normals[i], known.direction_at(points, i));
    if (cosine < -kSureCosine) normals[i] = -normals[i];
  }
}

Sheets find_sheets(const NeighbourGraph& graph, const std::vector<glm::vec3>& normals) {
  DisjointSets sets(normals.size());
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    for (const std::uint32_t j : graph.of(i))
      if (glm::dot(normals[i], normals[j]) > 0.0F) sets.join(i, j);
  }
  constexpr auto kUnnumbered = static_cast<std::uint32_t>(-1);
  Sheets sheets{std::vector<std::uint32_t>(normals.size()), 0};
  std::vector<std::uint32_t> number_of_root(normals.size(), kUnnumbered);
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    std::uint32_t& number = number_of_root[sets.find(i)];
    if (number == kUnnumbered) number = sheets.count++;
    sheets.of_point[i] = number;
  }
  return sheets;
}

}  // namespace relief
