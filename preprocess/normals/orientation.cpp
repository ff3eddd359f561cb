// Sides of normals that agree with the winding numbers that the surface itself has ([Lin 2024]).
#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "common/bounds.h"
#include "common/disjoint_sets.h"
#include "preprocess/normals/normals.h"
#include "preprocess/normals/refine_sides.h"
#include "preprocess/normals/sampled_sides.h"
#include "preprocess/normals/side_energy.h"
#include "preprocess/normals/side_pieces.h"
#include "preprocess/normals/winding_energy.h"

namespace relief {
namespace {

// Sides of this many pieces are chosen together: the matrix of all pairs has 6 MB, and the time,
// 0.1 to 0.3 s, does not grow with the scan.
constexpr std::size_t kMostPieces = 1200;
// Six places instead of three changed nothing.
constexpr std::size_t kPlacesPerPiece = 3;
// Winding numbers that places may have: of a closed surface, of one whose ground is as wide as its
// bodies, and of one on an open ground.
constexpr float kNumbers[] = {0.5F, 0.25F, 0.0F};
// A surface with this mean number is closed: no other is tried.
constexpr float kClosedNumber = 0.4F;

/// Sides of pieces, and the winding number that places on the surface should have with them.
struct ChosenSides {
  Eigen::VectorXf sides;
  float number = 0.5F;
};

/// The energy of sides without winding numbers.
SideEnergy known_energy(const SidePieces& pieces, const KnownSides& known) {
  const auto count = static_cast<Eigen::Index>(pieces.count());
  const std::vector<float> areas = areas_of(pieces.surface);
  SideEnergy energy{Eigen::MatrixXf::Zero(count, count), Eigen::VectorXf(count),
                    Eigen::VectorXf(count)};
  for (std::size_t a = 0; a < pieces.count(); ++a) {
    energy.areas[static_cast<Eigen::Index>(a)] = std::max(areas[a], kLeastPieceArea);
    energy.fields[static_cast<Eigen::Index>(a)] = known.weight * pieces.towards[pieces.chosen[a]];
  }
  for (const SideCoupling& c : pieces.couplings) {
    energy.pairs(c.a, c.b) += c.gain;
    energy.pairs(c.b, c.a) += c.gain;
  }
  return energy;
}

/// The sides for the winding number that fits best. What the known direction counts does not: it
/// would choose 0 for a bowl, which then faces up, into it.
ChosenSides choose_number(const WindingTerms& winding, SideEnergy& energy) {
  const Eigen::VectorXf known = energy.fields;
  const float area = energy.areas.sum();
  ChosenSides best;
  float least = std::numeric_limits<float>::infinity();
  for (const float number : kNumbers) {
    energy.fields = known + number * winding.number;
    const Eigen::VectorXf sides = choose_sides(energy);
    // The errors' part that does not depend on the sides is the number's square.
    const float error = energy_of(energy, sides) + known.dot(sides) + number * number * area;
    if (error < least || best.sides.size() == 0) best = {sides, number};  // NaN: the first
    least = std::min(least, error);
    if (0.5F * winding.number.dot(sides) > kClosedNumber * area) break;
  }
  return best;
}

/// `box`: that of the points, which a whole scan's sample has points in, too.
ChosenSides choose_together(const SidePieces& pieces, const KnownSides& known, const Bounds& box) {
  SideEnergy energy = known_energy(pieces, known);
  if (known.is_sure) return {choose_sides(energy)};
  const SurfacePlaces places = places_on(pieces.surface, kPlacesPerPiece);
  Eigen::VectorXf others =
      Eigen::VectorXf::Zero(static_cast<Eigen::Index>(places.positions.size()));
  if (known.whole != nullptr)
    others = known.whole->winding_numbers_beyond(box, places, pieces.centre);
  const WindingTerms winding =
      winding_terms(winding_numbers(pieces.surface, places), places, others);
  energy.pairs += winding.pairs;
  if (known.whole == nullptr) return choose_number(winding, energy);
  const float number = known.whole->number();
  energy.fields += winding.others + number * winding.number;
  return {choose_sides(energy), number};
}

}  // namespace

float orient_normals(const Points& points, const NeighbourGraph& graph, const SideChoice& choice,
                     std::vector<glm::vec3>& normals, const Progress& progress) {
  const KnownSides known = known_sides(points, choice);
  const SidePieces pieces =
      make_side_pieces(points, graph, known, limits_for(points.size(), kMostPieces), normals);
  if (progress.cancelled()) return 0.0F;
  const ChosenSides chosen = choose_together(pieces, known, bounds_of(points.positions));
  turn_pieces(pieces, chosen.sides, known, normals);
  if (known.is_sure) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float cosine = glm::dot(normals[i], known.direction_at(points, i));
      if (cosine < -kSureCosine) normals[i] = -normals[i];
    }
  } else if (known.whole == nullptr && are_sides_coarse(points.size())) {
    refine_sides(points, graph, known, chosen.number, normals, progress);
  }
  return chosen.number;
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
