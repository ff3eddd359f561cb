#include "renderer/volume/splats/share_before.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace relief {

double share_before(const Footprint& footprint, glm::dvec2 from_centre, double depth) {
  const double beyond = depth - footprint.depth - glm::dot(footprint.slope, from_centre);
  if (!(footprint.depth_deviation > 0.0)) return beyond > 0.0 ? 1.0 : 0.0;
  return 0.5 * std::erfc(-beyond / (std::numbers::sqrt2 * footprint.depth_deviation));
}

double weight_before(double weight, double share, KernelWeight kind) {
  if (kind == KernelWeight::Integral || share == 0.0 || share == 1.0) return weight * share;
  return -std::expm1(share * std::log1p(-weight));
}

}  // namespace relief
