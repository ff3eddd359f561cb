#include "renderer/volume/coarse_kernels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "renderer/volume/extent.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief {
namespace {

/// What kernels of 2 x 2 x 2 nodes add up to.
struct Sum {
  double weight = 0.0;
  glm::dvec3 place{0.0};   ///< times the weights, from the grid's origin
  glm::dvec3 colour{0.0};  ///< likewise
  glm::dvec3 normal{0.0};
};

/// The weight of a kernel that has the space `space` to itself, so that one layer lets through what
/// two of half the spacing did, whose opacities were their optical depths.
double weight_of_two_layers(double weight, double space) {
  const double spacing = std::cbrt(space);
  const double depth = std::min(0.5 * weight / space * spacing, 1.0);  // of one of the two
  return depth * (2.0 - depth) * space / spacing;
}

KernelCloud halved(const KernelCloud& fine, const RegularGrid& grid, double space,
                   Attenuation attenuation) {
  KernelCloud coarse;
  coarse.weight = fine.weight;
  coarse.size = (fine.size + 1U) / 2U;
  coarse.across = fine.across;
  std::vector<Sum> sums(std::size_t{coarse.size.x} * coarse.size.y * coarse.size.z);
  for (std::size_t k = 0; k < fine.count(); ++k) {
    const glm::uvec3 node = fine.node(k) / 2U;
    Sum& sum =
        sums[node.x + std::size_t{coarse.size.x} * (node.y + std::size_t{coarse.size.y} * node.z)];
    const double weight = fine.weights[k];
    sum.weight += weight;
    sum.place += weight * (fine.centres[k] - grid.origin);
    sum.colour += weight * glm::dvec3(fine.colours[k]);
    sum.normal += weight * glm::dvec3(fine.normals[k]);
  }
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const Sum& sum = sums[n];
    if (!(sum.weight > 0.0)) continue;
    const double length = glm::length(sum.normal);
    coarse.centres.push_back(grid.origin + sum.place / sum.weight);
    coarse.colours.emplace_back(sum.colour / sum.weight);
    coarse.normals.push_back(length > 0.0 ? glm::vec3(sum.normal / length) : glm::vec3(0.0F));
    coarse.weights.push_back(static_cast<float>(
        attenuation == Attenuation::Linear ? weight_of_two_layers(sum.weight, space) : sum.weight));
    coarse.nodes.push_back(static_cast<std::uint32_t>(n));
  }
  return coarse;
}

}  // namespace

int coarse_level(const ScalarVolume& volume, const RegularGrid& grid, const View& view,
                 double pixels) {
  const RayCamera camera = ray_camera(view);
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& corner : extent_of(volume))
    nearest = std::min(nearest, to_camera(camera, corner).z);
  if (!camera.orthographic && !(nearest > 0.0)) return 0;
  const double step =
      std::max({glm::length(grid.step[0]), glm::length(grid.step[1]), glm::length(grid.step[2])});
  const double scale = std::max(camera.scale.x, camera.scale.y);
  const double apart = step * scale / (camera.orthographic ? 1.0 : nearest);
  const std::uint32_t nodes = std::max({volume.size.x, volume.size.y, volume.size.z});
  int level = 0;
  while ((nodes >> (level + 1)) > 1U && std::ldexp(apart, level + 1) <= pixels) ++level;
  return level;
}

KernelCloud coarse_kernels(KernelCloud cloud, const RegularGrid& grid, int level,
                           Attenuation attenuation) {
  Variance variance = cloud.variances.front();
  glm::dmat3 step = grid.step;
  for (int l = 0; l < level; ++l) {
    // Places half a step off their mean, either way, along each axis.
    variance = variance_of(matrix_of(variance) + 0.25 * step * glm::transpose(step));
    step *= 2.0;
    cloud = halved(cloud, grid, std::abs(glm::determinant(step)), attenuation);
  }
  cloud.variances = {variance};
  return cloud;
}

}  // namespace relief
