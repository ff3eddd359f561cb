#include "renderer/clip/plane_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace relief {
namespace {

constexpr std::size_t kSides = 48;

/// The corners of a polygon about the unit circle.
std::array<glm::dvec2, kSides> polygon_about_circle() {
  std::array<glm::dvec2, kSides> corners{};
  const double reach = 1.0 / std::cos(std::numbers::pi / kSides);
  for (std::size_t k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kSides;
    corners[k] = reach * glm::dvec2(std::cos(angle), std::sin(angle));
  }
  return corners;
}

/// Keeps of groups of one line those that bound what all of them leave.
void keep_of_union(std::vector<PlaneLine>& lines, double along_x, double along_y,
                   double tolerance) {
  DiscPart kept;
  kept.start(along_x, along_y);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const PlaneLine& a, const PlaneLine& b) { return a.offset < b.offset; });
  for (const PlaneLine& line : lines)
    if (kept.beyond(line) > tolerance) kept.cut_beyond(line);
  std::erase_if(lines, [&](const PlaneLine& line) { return !kept.is_bounded_by(line.partner); });
}

/// Keeps of the lines of a group those that bound what is beyond all. None if nothing is.
void keep_of_intersection(std::vector<PlaneLine>& lines, double along_x, double along_y,
                          double tolerance) {
  DiscPart clipped;
  clipped.start(along_x, along_y);
  // The farthest first: most others do not bound what it leaves.
  std::stable_sort(lines.begin(), lines.end(),
                   [](const PlaneLine& a, const PlaneLine& b) { return a.offset > b.offset; });
  for (const PlaneLine& line : lines) {
    const PlaneLine inverse{-line.direction, -line.offset, line.partner};
    if (clipped.beyond(inverse) > tolerance) clipped.cut_beyond(inverse);
  }
  if (clipped.is_empty()) {
    lines.clear();
    return;
  }
  std::erase_if(lines, [&](const PlaneLine& line) { return !clipped.is_bounded_by(line.partner); });
}

}  // namespace

void DiscPart::start(double along_x, double along_y) {
  static const std::array<glm::dvec2, kSides> circle = polygon_about_circle();
  corners_.clear();
  for (const glm::dvec2 corner : circle)
    corners_.push_back({corner * glm::dvec2(along_x, along_y), kDisc});
}

double DiscPart::beyond(const PlaneLine& line) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Corner& corner : corners_)
    most = std::max(most, glm::dot(corner.at, line.direction) - line.offset);
  return most;
}

bool DiscPart::is_bounded_by(std::uint32_t partner) const {
  return std::any_of(corners_.begin(), corners_.end(),
                     [&](const Corner& corner) { return corner.edge == partner; });
}

void DiscPart::cut_beyond(const PlaneLine& line) {
  next_.clear();
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Corner& from = corners_[k];
    const Corner& to = corners_[k + 1 == corners_.size() ? 0 : k + 1];
    const double a = glm::dot(from.at, line.direction) - line.offset;
    const double b = glm::dot(to.at, line.direction) - line.offset;
    if (a <= 0.0) next_.push_back(from);
    if ((a <= 0.0) == (b <= 0.0)) continue;
    // Leaves what is kept: the line bounds it from here. Enters it: the old edge goes on.
    next_.push_back(
        {from.at + (a / (a - b)) * (to.at - from.at), a <= 0.0 ? line.partner : from.edge});
  }
  std::swap(corners_, next_);
}

void keep_bounding_lines(std::vector<std::vector<PlaneLine>>& groups, double along_x,
                         double along_y, double tolerance) {
  std::vector<PlaneLine> alone;
  for (auto& group : groups) {
    if (group.size() > 1) keep_of_intersection(group, along_x, along_y, tolerance);
    if (group.size() != 1) continue;
    alone.push_back(group.front());
    group.clear();
  }
  keep_of_union(alone, along_x, along_y, tolerance);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  for (const PlaneLine& line : alone) groups.push_back({line});
}

}  // namespace relief
