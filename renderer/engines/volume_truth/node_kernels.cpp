#include "renderer/engines/volume_truth/node_kernels.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

namespace relief::volume_truth {
namespace {

double gaussian(double from_middle, double sigma) {
  return std::exp(-0.5 * from_middle * from_middle / (sigma * sigma));
}

}  // namespace

Reached::Reached(double at, double reach)
    : first(static_cast<int>(std::ceil(at - reach))),
      last(static_cast<int>(std::floor(at + reach))) {}

NodeKernels::NodeKernels(const KernelCloud& cloud, std::span<const glm::vec3> colours,
                         const RegularGrid& grid, double sigma)
    : size_(cloud.size), sigma_(sigma) {
  nodes_.resize(std::size_t{cloud.size.x} * cloud.size.y * cloud.size.z, glm::vec4(0.0F));
  const double root = std::sqrt(2.0 * std::numbers::pi) * sigma;
  middle_ = 1.0 / (root * root * root * std::abs(glm::determinant(grid.step)));
  for (std::size_t k = 0; k < cloud.count(); ++k) {
    nodes_[cloud.nodes[k]] = glm::vec4(cloud.weights[k] * colours[k], cloud.weights[k]);
  }
}

std::size_t NodeKernels::stride(int axis) const {
  std::size_t product = 1;
  for (int a = 0; a < axis; ++a) product *= static_cast<std::size_t>(size_[a]);
  return product;
}

Density NodeKernels::sum_at(glm::dvec3 place) const {
  Density sum;
  const Reached x(place.x, reach());
  const Reached y(place.y, reach());
  const Reached z(place.z, reach());
  for (int k = std::max(z.first, 0); k <= std::min(z.last, size_.z - 1); ++k) {
    for (int j = std::max(y.first, 0); j <= std::min(y.last, size_.y - 1); ++j) {
      const double outer = middle_ * gaussian(k - place.z, sigma_) * gaussian(j - place.y, sigma_);
      const std::size_t line =
          static_cast<std::size_t>(k) * stride(2) + static_cast<std::size_t>(j) * stride(1);
      for (int i = std::max(x.first, 0); i <= std::min(x.last, size_.x - 1); ++i) {
        const double weight = outer * gaussian(i - place.x, sigma_);
        const glm::vec4& node = nodes_[line + static_cast<std::size_t>(i)];
        for (int c = 0; c < 4; ++c)
          sum.values[static_cast<std::size_t>(c)] += weight * static_cast<double>(node[c]);
      }
    }
  }
  return sum;
}

void NodeKernels::sum_across(int axis, double at, int row, std::span<Density> line) const {
  const Reached across(at, reach());
  const int along = (axis + 1) % 3;
  const std::size_t step = stride(along);
  for (int n = std::max(across.first, 0); n <= std::min(across.last, size_[axis] - 1); ++n) {
    const double weight = middle_ * gaussian(n - at, sigma_);
    std::size_t node = static_cast<std::size_t>(n) * stride(axis) +
                       static_cast<std::size_t>(row) * stride((axis + 2) % 3);
    for (Density& density : line) {
      const glm::vec4& own = nodes_[node];
      if (own.w > 0.0F) {
        for (int c = 0; c < 4; ++c)
          density.values[static_cast<std::size_t>(c)] += weight * static_cast<double>(own[c]);
      }
      node += step;
    }
  }
}

}  // namespace relief::volume_truth
