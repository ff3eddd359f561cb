#include "preprocess/normals/refine_sides.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "preprocess/normals/side_energy.h"
#include "preprocess/normals/side_pieces.h"
#include "preprocess/normals/winding_energy.h"

namespace relief {
namespace {

using Index = Eigen::Index;
using Numbers = std::vector<std::uint32_t>;  // of pieces

constexpr std::size_t kMostFinePieces = 16'000;
// Fewer points have pieces nearly as small from the start.
constexpr std::size_t kFewestRefined = 120'000;
// Twice or half as many changed 0.3 % of the bodies on the ground of scripts/large_scan.py.
constexpr std::size_t kBlockPieces = 200;
constexpr std::size_t kWindowPieces = 600;
// The mean squared error of a block's winding numbers of which none gets better: half of the blocks
// of scripts/large_scan.py's ground.
constexpr float kFits = 0.005F;

/// The box of the centres of some pieces.
struct CentreBox {
  glm::vec3 low{0.0F};
  glm::vec3 high{0.0F};
};

CentreBox box_of(const Numbers& pieces, const std::vector<PieceDipole>& dipoles) {
  CentreBox box{dipoles[pieces.front()].centre, dipoles[pieces.front()].centre};
  for (const std::uint32_t k : pieces) {
    box.low = glm::min(box.low, dipoles[k].centre);
    box.high = glm::max(box.high, dipoles[k].centre);
  }
  return box;
}

/// Pieces in halves of halves of their box, at most kBlockPieces in each.
void cut_into_blocks(Numbers pieces, const std::vector<PieceDipole>& dipoles,
                     std::vector<Numbers>& blocks) {
  if (pieces.size() <= kBlockPieces) {
    blocks.push_back(std::move(pieces));
    return;
  }
  const CentreBox box = box_of(pieces, dipoles);
  const glm::vec3 size = box.high - box.low;
  int axis = size.y > size.x ? 1 : 0;
  if (size.z > size[axis]) axis = 2;
  std::ranges::sort(pieces, {}, [&dipoles, axis](std::uint32_t k) {
    return std::pair(dipoles[k].centre[axis], k);
  });
  const auto middle = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
  cut_into_blocks({pieces.begin(), middle}, dipoles, blocks);
  cut_into_blocks({middle, pieces.end()}, dipoles, blocks);
}

class Refinement {
 public:
  Refinement(const SidePieces& pieces, const KnownSides& known, float number, Eigen::VectorXf sides)
      : pieces_(&pieces),
        known_(&known),
        number_(number),
        areas_(areas_of(pieces.surface)),
        dipoles_(dipoles_of(pieces.surface)),
        places_(places_on(pieces.surface, 1)),
        coupled_(pieces.count()),
        sides_(std::move(sides)),
        numbers_(total_winding_numbers(pieces.surface, dipoles_, sides_, places_)) {
    for (const SideCoupling& c : pieces.couplings) {
      coupled_[c.a].emplace_back(c.b, c.gain);
      coupled_[c.b].emplace_back(c.a, c.gain);
    }
  }

  void run(const Progress& progress) {
    Numbers all(pieces_->count());
    for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
    std::vector<Numbers> blocks;
    cut_into_blocks(std::move(all), dipoles_, blocks);
    for (const Numbers& block : blocks) {
      if (progress.cancelled()) return;
      float error = 0.0F;
      float area = 0.0F;
      for (const std::uint32_t k : block) {
        const float off = numbers_[static_cast<Index>(k)] - number_;
        error += areas_[k] * off * off;
        area += areas_[k];
      }
      if (error > kFits * area) choose_again(window_about(block));
    }
  }

  [[nodiscard]] const Eigen::VectorXf& sides() const { return sides_; }

 private:
  /// The pieces nearest to the box of a block, its own among them, ascending.
  [[nodiscard]] Numbers window_about(const Numbers& block) const {
    const CentreBox box = box_of(block, dipoles_);
    std::vector<std::pair<float, std::uint32_t>> near(dipoles_.size());
    for (std::uint32_t k = 0; k < near.size(); ++k) {
      const glm::vec3 centre = dipoles_[k].centre;
      const glm::vec3 off =
          glm::max(glm::max(box.low - centre, centre - box.high), glm::vec3(0.0F));
      near[k] = {glm::dot(off, off), k};
    }
    const std::size_t count = std::min(kWindowPieces, near.size());
    std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(count - 1));
    Numbers window(count);
    for (std::size_t m = 0; m < count; ++m) window[m] = near[m].second;
    std::ranges::sort(window);
    return window;
  }

  [[nodiscard]] PiecedSurface surface_of(const Numbers& window) const {
    const PiecedSurface& all = pieces_->surface;
    PiecedSurface own;
    for (const std::uint32_t k : window) {
      own.first.push_back(static_cast<std::uint32_t>(own.positions.size()));
      for (std::uint32_t i = all.first[k]; i < all.first[k + 1]; ++i) {
        own.positions.push_back(all.positions[i]);
        own.area_normals.push_back(all.area_normals[i]);
      }
    }
    own.first.push_back(static_cast<std::uint32_t>(own.positions.size()));
    return own;
  }

  [[nodiscard]] SurfacePlaces places_of(const Numbers& window) const {
    SurfacePlaces own;
    for (const std::uint32_t k : window) {
      own.positions.push_back(places_.positions[k]);
      own.areas.push_back(places_.areas[k]);
    }
    return own;
  }

  /// The energy of a window's sides, with all other pieces as they are.
  [[nodiscard]] SideEnergy energy_about(const Numbers& window) const {
    const auto count = static_cast<Index>(window.size());
    const SurfacePlaces places = places_of(window);
    Eigen::MatrixXf numbers = winding_numbers(surface_of(window), places);
    // A vector of its own: GCC 14 suspects a null pointer in the product with an indexed view.
    const Eigen::VectorXf own = sides_(window);
    const Eigen::VectorXf others = numbers_(window) - numbers * own;
    WindingTerms winding = winding_terms(std::move(numbers), places, others);
    SideEnergy energy{std::move(winding.pairs), winding.others + number_ * winding.number,
                      Eigen::VectorXf(count)};
    std::vector<Index> place_of(pieces_->count(), -1);
    for (Index m = 0; m < count; ++m) place_of[window[static_cast<std::size_t>(m)]] = m;
    for (Index m = 0; m < count; ++m) {
      const std::uint32_t k = window[static_cast<std::size_t>(m)];
      energy.areas[m] = std::max(areas_[k], kLeastPieceArea);
      energy.fields[m] += known_->weight * pieces_->towards[pieces_->chosen[k]];
      for (const auto& [other, gain] : coupled_[k]) {
        if (place_of[other] >= 0)
          energy.pairs(m, place_of[other]) += gain;
        else
          energy.fields[m] += gain * sides_[static_cast<Index>(other)];
      }
    }
    return energy;
  }

  void choose_again(const Numbers& window) {
    const SideEnergy energy = energy_about(window);
    const Eigen::VectorXf before = sides_(window);
    const Eigen::VectorXf after = choose_sides(energy);
    if (!(energy_of(energy, after) < energy_of(energy, before))) return;
    Numbers turned;
    for (std::size_t m = 0; m < window.size(); ++m) {
      const auto k = static_cast<Index>(window[m]);
      if (after[static_cast<Index>(m)] == sides_[k]) continue;
      sides_[k] = after[static_cast<Index>(m)];
      turned.push_back(window[m]);
    }
    const PiecedSurface surface = surface_of(turned);
    numbers_ += total_winding_numbers(surface, dipoles_of(surface), 2.0F * sides_(turned), places_);
  }

  const SidePieces* pieces_;
  const KnownSides* known_;
  float number_;
  std::vector<float> areas_;
  std::vector<PieceDipole> dipoles_;
  SurfacePlaces places_;  // one on each piece: with two or three, 0.3 % changed
  std::vector<std::vector<std::pair<std::uint32_t, float>>> coupled_;  // with what gain
  Eigen::VectorXf sides_;
  Eigen::VectorXf numbers_;  // about the places, with these sides
};

}  // namespace

bool are_sides_coarse(std::size_t points) {
  return points >= kFewestRefined;
}

void refine_sides(const Points& points, const NeighbourGraph& graph, const KnownSides& known,
                  float number, std::vector<glm::vec3>& normals, const Progress& progress) {
  const std::vector<glm::vec3> before = normals;
  const SidePieces pieces =
      make_side_pieces(points, graph, known, limits_for(points.size(), kMostFinePieces), normals);
  Refinement refinement(pieces, known, number, sides_as(before, pieces, graph, normals));
  refinement.run(progress);
  turn_pieces(pieces, refinement.sides(), known, normals);
}

}  // namespace relief
