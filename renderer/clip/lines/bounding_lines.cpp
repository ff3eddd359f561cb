#include "renderer/clip/lines/bounding_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace relief {
namespace {

constexpr double kInvisible = 1e-4;
/// Sides of the polygon about a disc, which is 0.2 % larger.
constexpr std::size_t kSides = 48;
constexpr std::uint32_t kDiscBorder = 0xffffffffU;

std::array<glm::dvec2, kSides> polygon_about_circle() {
  std::array<glm::dvec2, kSides> corners{};
  const double reach = 1.0 / std::cos(std::numbers::pi / kSides);
  for (std::size_t k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kSides;
    corners[k] = reach * glm::dvec2(std::cos(angle), std::sin(angle));
  }
  return corners;
}

/// A convex part of a disc, bounded by lines and the disc's border.
class DiscPart {
 public:
  explicit DiscPart(const SplatFrame& frame) {
    static const std::array<glm::dvec2, kSides> circle = polygon_about_circle();
    for (const glm::dvec2 corner : circle)
      corners_.push_back({corner * glm::dvec2(frame.along_x, frame.along_y), kDiscBorder});
  }

  [[nodiscard]] bool is_empty() const { return corners_.empty(); }

  /// How far the part reaches beyond a line; negative if it does not.
  [[nodiscard]] double beyond(glm::dvec2 direction, double offset) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Corner& corner : corners_)
      most = std::max(most, glm::dot(corner.at, direction) - offset);
    return most;
  }

  [[nodiscard]] bool is_bounded_by(std::uint32_t partner) const {
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](const Corner& corner) { return corner.edge == partner; });
  }

  /// Cuts off what is beyond a line.
  void cut(glm::dvec2 direction, double offset, std::uint32_t partner) {
    std::vector<Corner> left;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Corner& from = corners_[k];
      const Corner& to = corners_[k + 1 == corners_.size() ? 0 : k + 1];
      const double a = glm::dot(from.at, direction) - offset;
      const double b = glm::dot(to.at, direction) - offset;
      if (a <= 0.0) left.push_back(from);
      if ((a <= 0.0) == (b <= 0.0)) continue;
      // Where the border leaves what is kept, the line goes on; where it enters, the old edge.
      left.push_back({from.at + (a / (a - b)) * (to.at - from.at), a <= 0.0 ? partner : from.edge});
    }
    corners_ = std::move(left);
  }

 private:
  struct Corner {
    glm::dvec2 at;
    std::uint32_t edge;  // the partner whose line goes from here to the next corner
  };

  std::vector<Corner> corners_;
};

void keep_of_union(LineGroup& lines, const SplatFrame& frame, double tolerance) {
  DiscPart kept(frame);
  // The nearest first: most others do not bound what it leaves.
  std::stable_sort(lines.begin(), lines.end(),
                   [](const PlaneLine& a, const PlaneLine& b) { return a.offset < b.offset; });
  for (const PlaneLine& line : lines)
    if (kept.beyond(line.direction, line.offset) > tolerance)
      kept.cut(line.direction, line.offset, line.partner);
  std::erase_if(lines, [&](const PlaneLine& line) { return !kept.is_bounded_by(line.partner); });
}

void keep_of_intersection(LineGroup& lines, const SplatFrame& frame, double tolerance) {
  DiscPart clipped(frame);
  // The farthest first: most others do not bound what is beyond it.
  std::stable_sort(lines.begin(), lines.end(),
                   [](const PlaneLine& a, const PlaneLine& b) { return a.offset > b.offset; });
  for (const PlaneLine& line : lines)
    if (clipped.beyond(-line.direction, -line.offset) > tolerance)
      clipped.cut(-line.direction, -line.offset, line.partner);
  std::erase_if(lines, [&](const PlaneLine& line) { return !clipped.is_bounded_by(line.partner); });
}

}  // namespace

void keep_bounding_lines(std::vector<LineGroup>& groups, const SplatFrame& frame) {
  const double tolerance = kInvisible * frame.along_x;
  LineGroup alone;
  for (LineGroup& group : groups) {
    if (group.size() > 1) keep_of_intersection(group, frame, tolerance);
    if (group.size() != 1) continue;
    alone.push_back(group.front());
    group.clear();
  }
  keep_of_union(alone, frame, tolerance);
  std::erase_if(groups, [](const LineGroup& group) { return group.empty(); });
  for (const PlaneLine& line : alone) groups.push_back({line});
}

}  // namespace relief
