// Finds the triangle of a mesh that each texel of a patch's maps shows.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// The index for texels without a triangle.
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// Returns, for each texel of a map with `scale` texels per cell, the index in `triangles` of the
/// one nearest to the patch's surface along its normal, at most three cells away. Triangles that
/// face away count as three cells farther. Row-major.
[[nodiscard]] std::vector<std::uint32_t> find_shown(const Patch& patch, std::uint32_t scale,
                                                    const std::vector<FlatTriangle>& triangles);

/// A triangle's texture coordinates as a function of the position on its patch. They are linear, so
/// that the step between texels is constant.
class TexcoordsOverPatch {
 public:
  /// `scale`: texels per cell. `triangle` must outlive this object.
  TexcoordsOverPatch(const FlatTriangle& triangle, const CornerTexcoords& corners, double scale);

  /// Returns the texture coordinates at a position in grid coordinates.
  [[nodiscard]] glm::dvec2 at(glm::dvec2 position) const;
  /// Return the change from texel to texel, along a row and along a column.
  [[nodiscard]] glm::vec2 du() const { return du_; }
  [[nodiscard]] glm::vec2 dv() const { return dv_; }

 private:
  const FlatTriangle* triangle_;
  CornerTexcoords corners_;
  glm::vec2 du_{0.0F};
  glm::vec2 dv_{0.0F};
};

}  // namespace relief
