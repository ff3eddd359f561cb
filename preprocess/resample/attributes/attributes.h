// Computes the attribute maps of a patch: normals and colours on its base plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/patch.h"
#include "preprocess/resample/attributes/normal_source.h"
#include "preprocess/resample/heights/mls.h"
#include "preprocess/resample/support/support.h"

namespace relief {

/// Returns the mean of the values around a position, for scans finer than the texels, which are
/// `step` apart. `value_of`: of a point of the patch.
template <class ValueOf>
[[nodiscard]] glm::vec3 mean_around(const PatchPoints& points, const PointGrid& lookup,
                                    glm::dvec2 position, std::uint32_t nearest, double step,
                                    const ValueOf& value_of) {
  const double to_nearest = glm::distance(glm::dvec2(points.positions[nearest]), position);
  // At least the distance to the nearest point, so that some weight is above 0.
  const double radius = std::max(0.5 * step, 0.6 * to_nearest);
  glm::vec3 sum(0.0F);
  float weights = 0.0F;
  lookup.for_each_within(
      position.x, position.y, 2.5 * radius, [&](std::uint32_t p, double squared) {
        const auto w = static_cast<float>(std::exp(-squared / (radius * radius)));
        sum += w * value_of(p);
        weights += w;
      });
  return sum / weights;
}

/// Returns whether a texel of a map has a value of its own: one of the nodes around it is a sample.
[[nodiscard]] bool beside_sample(const std::vector<NodeState>& states, const PatchGrid& grid,
                                 std::uint32_t a, std::uint32_t b, std::uint32_t scale);

/// Sets one normal per grid node. Holes continue their surroundings.
[[nodiscard]] AttributeMap<glm::i16vec2> sample_normals(const std::vector<MlsPoint>& surface,
                                                        const std::vector<NodeState>& states,
                                                        const PatchGrid& grid, NormalSource source);

/// Sets a colour map of `scale` texels per grid cell. Colours are interpolated between the points
/// (ColourInterpolation); where the scan is finer than the texels, they are means of nearby points.
/// Both in linear light. `colours` has one colour for each point of the scan.
[[nodiscard]] AttributeMap<glm::u8vec3> sample_colours(
    const PatchPoints& points, const PointGrid& lookup, const std::vector<NodeState>& states,
    const PatchGrid& grid, const std::vector<glm::u8vec3>& colours, std::uint32_t scale);

}  // namespace relief
