// Clip lines in the plane of a splat, and what they leave of its disc.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace relief {

/// The border of a clip area in the coordinates of the splat's plane, its centre the origin: what
/// is beyond, dot(P, direction) > offset, is clipped.
struct PlaneLine {
  glm::dvec2 direction;   ///< unit
  double offset;          ///< 0 or more: no splat loses its centre
  std::uint32_t partner;  ///< which of the splat's partners, from 0
};

/// A convex part of a disc, bounded by the disc's border and lines.
class DiscPart {
 public:
  /// Makes it an ellipse, as a polygon about it (0.2 % larger).
  void start(double along_x, double along_y);

  /// Cuts off what is beyond a line.
  void cut_beyond(const PlaneLine& line);

  [[nodiscard]] bool is_empty() const { return corners_.empty(); }
  /// How far the part reaches beyond a line, world units; negative if it does not.
  [[nodiscard]] double beyond(const PlaneLine& line) const;
  /// Whether a line bounds it.
  [[nodiscard]] bool is_bounded_by(std::uint32_t partner) const;

 private:
  static constexpr std::uint32_t kDisc = 0xffffffffU;

  struct Corner {
    glm::dvec2 at;
    std::uint32_t edge;  ///< what bounds the part from here to the next corner
  };

  std::vector<Corner> corners_;
  std::vector<Corner> next_;
};

/// Keeps of each group of lines those that bound the result inside the disc. Groups are united,
/// the lines of a group are intersected. What a line changes by less than `tolerance`, world units,
/// counts as nothing.
void keep_bounding_lines(std::vector<std::vector<PlaneLine>>& groups, double along_x,
                         double along_y, double tolerance);

}  // namespace relief
