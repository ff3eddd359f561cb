// Interpolates colours between the points of a scan.
#pragma once

#include <cstdint>
#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/resample/surroundings/point_grid.h"

namespace relief {

/// Interpolates the colours of a patch's points over its base plane by ordinary kriging with the
/// linear variogram (Matheron 1963): exact at points, never beyond the surrounding colours, and the
/// best linear method for colours that change at edges, because their mean squared difference grows
/// with the distance. Distances are along the surface, and shorter along an edge than across it:
/// the metric is steered by the structure tensor of the colours (as the kernels of Takeda et al.
/// 2007, Kernel regression for image processing and reconstruction).
class ColourInterpolation {
 public:
  /// `colours`: one for each point of the scan, sRGB. Keeps references; `lookup` is over all of
  /// `points`.
  ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                      const std::vector<glm::u8vec3>& colours);
  /// The same for values of each point of the patch, 0 to 1.
  ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                      std::vector<glm::vec3> values);

  /// Returns the linear colour at local (x, y). `nearest` is the nearest point.
  [[nodiscard]] glm::vec3 at(double x, double y, std::uint32_t nearest) const;

 private:
  /// Sum over the channels of the products of a gradient's components: along x, mixed, along y. Per
  /// squared unit on the base plane.
  using Tensor = glm::dvec3;

  [[nodiscard]] Tensor gradient_at(std::uint32_t point) const;
  /// Maps offsets on the base plane to where distances are longer across an edge of the colours
  /// than along it, in spacings.
  [[nodiscard]] glm::dmat2 metric_at(double x, double y, std::uint32_t nearest) const;

  const PatchPoints& points_;
  const PointGrid& lookup_;
  std::vector<glm::vec3> values_;  ///< linear
  std::vector<Tensor> tensors_;    ///< per point
};

}  // namespace relief
