// How far every splat of a patch extends.
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "renderer/padded_heights.h"
#include "renderer/splat_slopes.h"

namespace relief {

/// Finds how far splats extend over the base plane toward -x, +x, -y and +y, in cells.
///
/// Between two neighbours each splat ends where their tangent planes meet: half-way on even ground,
/// but at the crest itself where one side is flat and the other steep; a splat that went half-way
/// there would stick out as a spike. Planes that part by less than kLeastStep in the middle meet
/// there. Splats of a cell reach at least as far as the others of that cell leave open, so that
/// their rectangles cover it. What the planes still part by where they should meet, g, is closed by
/// a margin: a view ray that rises by an angle of at least a over the surface can't pass between
/// two planes that both reach m >= g / (2 tan a) beyond that place. It is for a = 30 degrees, and
/// at most half a cell within the splat's plane: more closes no more holes and sticks out of
/// silhouettes (docs/decisions.md).
///
/// Toward a hole a splat extends half a spacing along its slope.
class SplatReach {
 public:
  SplatReach(const PaddedHeights& heights, const SplatSlopes& slopes, float height_step);

  /// The reach of the splat at padded index k.
  [[nodiscard]] glm::vec4 of(std::size_t k) const;

 private:
  /// Where the planes of two neighbours meet, from the first (0) to the second (1), and by how much
  /// they part there.
  struct Meeting {
    float place = 0.5F;
    float gap = 0.0F;
    bool exists = false;  ///< both are samples
  };
  [[nodiscard]] Meeting meet(std::size_t k, std::size_t step, glm::length_t axis) const;
  [[nodiscard]] float corner_gap(std::size_t cell) const;
  [[nodiscard]] float toward(std::size_t k, glm::length_t axis, bool forward) const;

  const PaddedHeights& heights_;
  const SplatSlopes& slopes_;
  float height_step_;
  std::vector<Meeting> along_x_;  ///< of a node and the next in its row, by padded index
  std::vector<Meeting> along_y_;  ///< of a node and the next in its column
};

}  // namespace relief
