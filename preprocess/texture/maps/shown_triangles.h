// Which triangle of a mesh each texel of a patch's maps shows.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// What a texel shows that meets no triangle.
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// For each texel of a map with `scale` texels a cell the index, in `triangles`, of the one that is
/// nearest to the patch's own surface along its normal, at most three cells away; one that faces
/// away counts as three cells farther. Row-major.
[[nodiscard]] std::vector<std::uint32_t> find_shown(const Patch& patch, std::uint32_t scale,
                                                    const std::vector<FlatTriangle>& triangles);

/// What weighs the texture coordinates of a triangle's corners at a place of its patch. Weights are
/// linear in the place, so that a texel's step is the same everywhere.
class TexcoordsOverPatch {
 public:
  /// `scale`: texels a cell. `triangle` must outlive it.
  TexcoordsOverPatch(const FlatTriangle& triangle, const CornerTexcoords& corners, double scale);

  /// At a place in grid coordinates.
  [[nodiscard]] glm::dvec2 at(glm::dvec2 place) const;
  /// Their change from texel to texel, along a row and along a column.
  [[nodiscard]] glm::vec2 du() const { return du_; }
  [[nodiscard]] glm::vec2 dv() const { return dv_; }

 private:
  const FlatTriangle* triangle_;
  CornerTexcoords corners_;
  glm::vec2 du_{0.0F};
  glm::vec2 dv_{0.0F};
};

}  // namespace relief
