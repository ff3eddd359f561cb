#include "renderer/geometry/samples/splat_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

namespace relief {
namespace {

// The margins of border splats are the same in all views, for rays that rise by 30 degrees over the
// surface: wider ones are spikes beyond the patch. The largest is in spacings along the plane.
constexpr float kLowestRay = 0.58F;  // tan 30 degrees
constexpr float kLargestFixedMargin = 0.5F;

// Planes that part by less than this where neighbours are half-way, in cells, need no other
// position: the spike would be as small, and a position found from smaller steps would be that of
// the noise.
constexpr float kMinStep = 0.1F;

/// Where the planes of two neighbours meet, from the first (0) to the second (1), and by how much
/// they part there, in cells.
struct Meeting {
  float position = 0.5F;
  float gap = 0.0F;
  bool exists = false;  ///< both are samples
};

/// A side of a splat, as an index of its reach.
glm::length_t side(glm::length_t axis, bool forward) {
  return 2 * axis + (forward ? 1 : 0);
}

class ReachFinder {
 public:
  ReachFinder(const PaddedHeights& heights, const SplatSlopes& slopes, float height_step,
              float to_hole)
      : heights_(heights),
        slopes_(slopes),
        height_step_(height_step),
        to_hole_(to_hole),
        stride_(heights.stride()),
        meetings_{std::vector<Meeting>(heights.size()), std::vector<Meeting>(heights.size())},
        reaches_(heights.size()) {}

  std::vector<SplatReach> find() {
    const std::size_t end = heights_.size() - stride_;
    for (std::size_t k = 0; k < end; ++k) {
      if (!heights_.valid(k)) continue;
      for (const glm::length_t axis : {0, 1}) meetings_[axis][k] = meet(k, axis);
    }
    for (std::size_t k = stride_; k < end; ++k) {
      if (heights_.valid(k)) reaches_[k].reach = reach_to_meetings(k);
    }
    for (std::size_t k = 0; k + 1 < end; ++k) close_pinhole(k);
    for (std::size_t k = stride_ + 1; k < end; ++k) {
      if (heights_.valid(k)) find_gaps(k);
    }
    return std::move(reaches_);
  }

 private:
  [[nodiscard]] std::size_t step(glm::length_t axis) const { return axis == 0 ? 1 : stride_; }

  [[nodiscard]] Meeting meet(std::size_t k, glm::length_t axis) const {
    const std::size_t next = k + step(axis);
    if (!heights_.valid(next)) return {};
    const float rise = height_step_ * static_cast<float>(heights_[next] - heights_[k]);
    const float second = slopes_.at(next)[axis];
    // The first plane is above the second by turn * t - lead at t from the first to the second.
    const float turn = slopes_.at(k)[axis] - second;
    const float lead = rise - second;
    const float half_way = 0.5F * turn - lead;
    float position = 0.5F;
    if (std::abs(half_way) > kMinStep && turn != 0.0F) {
      // The position nearest to the middle where they part by no more, if there is one between the
      // two.
      const float meeting = (std::copysign(kMinStep, half_way) + lead) / turn;
      if (meeting >= 0.0F && meeting <= 1.0F) position = meeting;
    }
    return {position, std::abs(turn * position - lead), true};
  }

  [[nodiscard]] glm::vec4 reach_to_meetings(std::size_t k) const {
    glm::vec4 reach(0.0F);
    for (const glm::length_t axis : {0, 1}) {
      const float slope = slopes_.at(k)[axis];
      const float to_hole = to_hole_ / std::sqrt(1.0F + slope * slope);
      const Meeting& before = meetings_[axis][k - step(axis)];
      const Meeting& after = meetings_[axis][k];
      reach[side(axis, false)] = before.exists ? 1.0F - before.position : to_hole;
      reach[side(axis, true)] = after.exists ? after.position : to_hole;
    }
    return reach;
  }

  /// The four rectangles of a cell with positions b, t of its bottom and top edge and l, r of its
  /// left and right one leave (b, t) x (l, r) open if they turn about it like a pinwheel.
  void close_pinhole(std::size_t cell) {
    const std::array<std::size_t, 4> nodes{cell, cell + 1, cell + stride_, cell + stride_ + 1};
    for (const std::size_t node : nodes) {
      if (!heights_.valid(node)) return;
    }
    const float b = meetings_[0][cell].position;
    const float t = meetings_[0][cell + stride_].position;
    const float l = meetings_[1][cell].position;
    const float r = meetings_[1][cell + 1].position;
    if ((t - b) * (l - r) <= 0.0F) return;
    // Going on along x, nodes 0 and 3 close it if b < t, nodes 1 and 2 otherwise; along y the other
    // two.
    std::size_t least = 0;
    glm::length_t least_axis = 0;
    float least_rise = std::numeric_limits<float>::max();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const glm::length_t axis = (b < t) == (n == 0 || n == 3) ? 0 : 1;
      const float rise = std::abs(slopes_.at(nodes[n])[axis]) * std::abs(axis == 0 ? t - b : l - r);
      if (rise >= least_rise) continue;
      least = n;
      least_axis = axis;
      least_rise = rise;
    }
    const bool forward = least_axis == 0 ? least % 2 == 0 : least < 2;
    const float far = least_axis == 0 ? (forward ? std::max(b, t) : 1.0F - std::min(b, t))
                                      : (forward ? std::max(l, r) : 1.0F - std::min(l, r));
    float& reach = reaches_[nodes[least]].reach[side(least_axis, forward)];
    reach = std::max(reach, far);
  }

  /// Spread of the planes of a cell's samples where its edges' meetings say that they meet (cells).
  [[nodiscard]] float corner_gap(std::size_t cell) const {
    const auto mean = [](const Meeting& a, const Meeting& b) {
      if (!a.exists) return b.position;
      return b.exists ? 0.5F * (a.position + b.position) : a.position;
    };
    const glm::vec2 middle(mean(meetings_[0][cell], meetings_[0][cell + stride_]),
                           mean(meetings_[1][cell], meetings_[1][cell + 1]));
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    std::size_t base = cell;
    for (const glm::length_t n : {0, 1, 2, 3}) {
      const glm::vec2 corner(n % 2, n / 2);
      const std::size_t node =
          cell + static_cast<std::size_t>(n % 2) + stride_ * static_cast<std::size_t>(n / 2);
      if (!heights_.valid(node)) continue;
      if (!heights_.valid(base)) base = node;
      const float height = height_step_ * static_cast<float>(heights_[node] - heights_[base]) +
                           glm::dot(slopes_.at(node), middle - corner);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return high > low ? high - low : 0.0F;
  }

  void find_gaps(std::size_t k) {
    const glm::vec2 slope = slopes_.at(k);
    const float cosine = 1.0F / std::sqrt(1.0F + glm::dot(slope, slope));
    const bool border = is_border(heights_, k);
    for (const glm::length_t axis : {0, 1}) {
      for (const bool forward : {false, true}) {
        const std::size_t edge = forward ? k : k - step(axis);
        if (!meetings_[axis][edge].exists) continue;
        const float gap = std::max(
            {meetings_[axis][edge].gap, corner_gap(edge), corner_gap(edge - step(1 - axis))});
        if (border) {
          reaches_[k].reach[side(axis, forward)] += fixed_margin(gap, cosine);
        } else {
          reaches_[k].gap[side(axis, forward)] = gap;
        }
      }
    }
  }

  const PaddedHeights& heights_;
  const SplatSlopes& slopes_;
  float height_step_;
  float to_hole_;
  std::size_t stride_;
  std::array<std::vector<Meeting>, 2> meetings_;  ///< of a node and the next along x and along y
  std::vector<SplatReach> reaches_;
};

}  // namespace

std::vector<SplatReach> find_reaches(const PaddedHeights& heights, const SplatSlopes& slopes,
                                     float height_step, float to_hole) {
  return ReachFinder(heights, slopes, height_step, to_hole).find();
}

float fixed_margin(float gap, float cosine) {
  return cosine * std::min(gap / (2.0F * kLowestRay), kLargestFixedMargin);
}

}  // namespace relief
