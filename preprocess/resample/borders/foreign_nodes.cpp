#include "preprocess/resample/borders/foreign_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "preprocess/normals/crease_sides.h"
#include "preprocess/resample/support/sectors.h"

namespace relief {
namespace {

// Points within this many grid spacings, or scan spacings if those are larger, are looked at.
constexpr double kSearchInSpacings = 2.0;
// Each has a vote of exp(-d^2 / s^2), s in the same spacings ...
constexpr double kVoteInSpacings = 0.7;
// ... and a node stays with this share of the votes for its own region. It is below a half so that
// where three regions meet none of a node's copies is lost; thin_borders() sees to the doubles.
constexpr double kOwnShare = 0.35;
// A node with no point in a sector wider than this, in radians, lies beyond the border of the
// scan's sheet ...
constexpr double kOpenSector = 190.0 / 180.0 * std::numbers::pi;
// ... and stays only if it is within this many grid spacings of a point.
constexpr double kOverhangInSpacings = 0.6;
// Beside a crease a point of its side is within this many spacings of a node: where planes of both
// sides meet too far out, fandisk's points alone had 20 samples up to 1.8 spacings off their edges.
constexpr double kAloneAtCrease = 1.2;
// Nodes may overhang a crease by this, in grid spacings.
constexpr double kOverhangAtCrease = 0.1;
// Beside a crease the fit of one side is taken where it is that near to the fit of all points ...
constexpr double kSureShift = 0.2;
// ... or to the plane of its side. Elsewhere it rests on few points that bend (lucy_50k: 0.6 dB).
constexpr double kNearSide = 0.05;
// ... and has a point of its side within this many spacings.
constexpr double kSideReach = 3.0;
// Nodes farther than this many rings from a hole are not looked at: regions end where support does.
constexpr std::int64_t kBorderRings = 3;

/// The widest angle between neighbouring directions.
double widest_sector(const std::vector<glm::dvec3>& directions) {
  std::vector<double> angles;
  angles.reserve(directions.size());
  for (const glm::dvec3& d : directions) angles.push_back(std::atan2(d.y, d.x));
  return widest_sectors(angles).width;
}

/// Nodes of the region's own, 1 if some node within kBorderRings is none or the grid ends there.
std::vector<std::uint8_t> near_border(const std::vector<NodeState>& states, const PatchGrid& grid) {
  const auto width = static_cast<std::int64_t>(grid.width);
  const auto height = static_cast<std::int64_t>(grid.height);
  // First along rows, then along columns.
  std::vector<std::uint8_t> in_row(states.size(), 0);
  std::vector<std::uint8_t> near(states.size(), 0);
  for (std::int64_t j = 0; j < height; ++j) {
    for (std::int64_t i = 0; i < width; ++i) {
      for (std::int64_t x = i - kBorderRings; x <= i + kBorderRings; ++x) {
        if (x < 0 || x >= width ||
            states[static_cast<std::size_t>(j * width + x)] != NodeState::Own)
          in_row[static_cast<std::size_t>(j * width + i)] = 1;
      }
    }
  }
  for (std::int64_t j = 0; j < height; ++j) {
    for (std::int64_t i = 0; i < width; ++i) {
      for (std::int64_t y = j - kBorderRings; y <= j + kBorderRings; ++y) {
        if (y < 0 || y >= height || in_row[static_cast<std::size_t>(y * width + i)] != 0)
          near[static_cast<std::size_t>(j * width + i)] = 1;
      }
    }
  }
  return near;
}

/// Decides about nodes one by one.
class NodeJudge {
 public:
  NodeJudge(const PatchSurroundings& around, const PatchGrid& grid)
      : around_(around),
        grid_(grid),
        normals_(around.creases != nullptr ? around.creases->points().normals
                                           : around.points.normals) {
    for (std::size_t p = 0; p < around.points.own; ++p)
      widest_ = std::max(widest_, double{around.points.spacing[p]});
  }

  /// What a node within the region's support becomes.
  NodeState judge(std::size_t node, MlsPoint& surface) {
    Spot spot = spot_at(node, surface);
    const std::optional<Crease> crease =
        around_.creases != nullptr ? around_.creases->near(spot.position, spot.side) : std::nullopt;
    if (crease && !stand_beside(*crease, surface, spot)) return NodeState::Hole;
    const Votes votes = count_votes(spot);
    // No point is within two spacings: it is on a face that goes on beyond a crease nobody saw,
    // where fandisk's points alone had 4 samples up to 2.8 spacings off.
    if (directions_.empty()) return NodeState::Hole;
    const double alone = kAloneAtCrease * std::max(grid_.spacing, widest_);
    if (crease && votes.nearest > alone * alone) return NodeState::Hole;
    const double own = votes.own + votes.tiles;
    if (own < kOwnShare * (own + votes.others)) return NodeState::Hole;
    const double overhang = kOverhangInSpacings * grid_.spacing;
    const bool overhangs = !crease && !around_.is_cut_later &&
                           votes.nearest > overhang * overhang &&
                           widest_sector(directions_) > kOpenSector;
    return overhangs ? NodeState::Hole : NodeState::Own;
  }

  /// What a node of the margin becomes where other tiles may be.
  NodeState judge_margin(std::size_t node, const MlsPoint& surface) {
    const Votes votes = count_votes(spot_at(node, surface));
    return votes.tiles > votes.others ? NodeState::Margin : NodeState::Hole;
  }

 private:
  struct Spot {
    glm::dvec3 position{0.0};
    glm::vec3 side{0.0F};  ///< normal of the surface that the node is of
    float like = 0.0F;     ///< cosine within which points' normals are of that side
  };

  struct Votes {
    double own = 0.0;
    double others = 0.0;
    double tiles = 0.0;                                   ///< other ones
    double nearest = std::numeric_limits<double>::max();  ///< squared distance
  };

  [[nodiscard]] Spot spot_at(std::size_t node, const MlsPoint& surface) const {
    const std::size_t row = node / grid_.width;
    return {{grid_.x0 + static_cast<double>(node % grid_.width) * grid_.spacing,
             grid_.y0 + static_cast<double>(row) * grid_.spacing, surface.height},
            surface.fitted_normal};
  }

  /// Moves a node to the surface of its side of a crease; false if it overhangs the other one.
  [[nodiscard]] bool stand_beside(const Crease& crease, MlsPoint& surface, Spot& spot) const {
    const std::optional<MlsPoint> on_side = evaluate_mls_beside_crease(
        around_.creases->points(), around_.creases->own(), around_.all, spot.position,
        kSideReach * std::max(grid_.spacing, widest_), crease.own.normal, grid_.spacing);
    if (on_side && is_sound(*on_side, crease.own, spot.position)) {
      surface.height = spot.position.z = on_side->height;
      surface.fitted_normal = on_side->fitted_normal;
      spot.side = crease.own.normal;
      spot.like = kCreaseSideCosine;
    }
    const std::optional<Crease> moved = around_.creases->near(spot.position, spot.side);
    return !moved || moved->distance >= -kOverhangAtCrease * grid_.spacing;
  }

  [[nodiscard]] bool is_sound(const MlsPoint& fit, const CreaseSide& side,
                              glm::dvec3 position) const {
    if (std::abs(fit.height - position.z) <= kSureShift * grid_.spacing) return true;
    const glm::dvec3 d = glm::dvec3(position.x, position.y, fit.height) - side.middle;
    return std::abs(glm::dot(d, glm::dvec3(side.normal))) <= kNearSide * grid_.spacing;
  }

  /// Also notes the directions to the points.
  Votes count_votes(const Spot& spot) {
    Votes votes;
    directions_.clear();
    heard_.clear();
    bool are_own = true;
    const PatchPoints& points = around_.points;
    around_.all.for_each_within(
        spot.position.x, spot.position.y, kSearchInSpacings * std::max(grid_.spacing, widest_),
        [&](std::uint32_t p, double plane_squared) {
          if (glm::dot(normals_[p], spot.side) <= spot.like) return;
          const glm::dvec3 d = points.positions[p] - spot.position;
          const double squared = plane_squared + d.z * d.z;
          const double spacing = std::max(grid_.spacing, double{points.spacing[p]});
          const double relative = squared / (spacing * spacing);
          if (relative <= kSearchInSpacings * kSearchInSpacings) directions_.push_back(d);
          votes.nearest = std::min(votes.nearest, squared);
          are_own = are_own && p < points.own;
          heard_.push_back({p, relative});
        });
    // Most nodes, even near borders, have no points about them but their region's.
    if (are_own) {
      votes.own = heard_.empty() ? 0.0 : 1.0;
      return votes;
    }
    for (const Voice& voice : heard_) {
      (voice.point < points.own                       ? votes.own
       : points.ids[voice.point] >= around_.of_others ? votes.tiles
                                                      : votes.others) +=
          std::exp(-voice.relative / (kVoteInSpacings * kVoteInSpacings));
    }
    return votes;
  }

  /// A point that has a vote.
  struct Voice {
    std::uint32_t point = 0;
    double relative = 0.0;  ///< squared distance in spacings
  };

  const PatchSurroundings& around_;
  const PatchGrid& grid_;
  const std::vector<glm::vec3>& normals_;
  double widest_ = 0.0;  ///< spacing of the region's points
  std::vector<glm::dvec3> directions_;
  std::vector<Voice> heard_;
};

}  // namespace

void drop_foreign_nodes(const PatchSurroundings& around, const PatchGrid& grid,
                        std::vector<MlsPoint>& surface, std::vector<NodeState>& states) {
  const std::vector<std::uint8_t> is_near_border = near_border(states, grid);
  const bool keeps_margins = std::ranges::any_of(
      around.points.ids, [&](std::uint32_t id) { return id >= around.of_others; });
  NodeJudge judge(around, grid);
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m] == NodeState::Hole) continue;
    if (states[m] == NodeState::Margin && keeps_margins) {
      states[m] = judge.judge_margin(m, surface[m]);
    } else if (is_near_border[m] != 0) {
      states[m] = judge.judge(m, surface[m]);
    }
  }
}

}  // namespace relief
