// The kernels of a regular grid as an array, to be summed at places in space.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "common/volume/scalar_volume.h"
#include "renderer/volume/kernels/kernel_cloud.h"

namespace relief::volume_truth {

/// Emission and extinction for a world unit.
struct Density {
  std::array<double, 4> values{};  ///< red, green, blue, extinction

  [[nodiscard]] double extinction() const { return values[3]; }
  /// Emission divided by extinction, which is above 0.
  [[nodiscard]] glm::dvec3 colour() const {
    return glm::dvec3(values[0], values[1], values[2]) / values[3];
  }
};

/// Kernels end so many standard deviations from their node along each axis of the grid: 2e-10 of
/// them is beyond.
inline constexpr double kReach = 6.5;

/// The nodes of a regular grid with what their kernels weigh. In the grid's own coordinates, where
/// node (i, j, k) is at (i, j, k), kernels are round, and a product of three Gaussians.
class NodeKernels {
 public:
  /// `cloud`: of a volume with that grid, without a surface. `colours`: of its kernels.
  NodeKernels(const KernelCloud& cloud, std::span<const glm::vec3> colours, const RegularGrid& grid,
              double sigma);

  [[nodiscard]] glm::ivec3 size() const { return size_; }
  [[nodiscard]] double sigma() const { return sigma_; }
  [[nodiscard]] double reach() const { return kReach * sigma_; }
  /// The sum at a place (the grid's coordinates).
  [[nodiscard]] Density sum_at(glm::dvec3 place) const;
  /// Adds what the kernels' sum is along one axis, at the plane `at` of it, to one line of that
  /// plane: along axis (axis + 1) % 3, at node `row` of axis (axis + 2) % 3.
  void sum_across(int axis, double at, int row, std::span<Density> line) const;

 private:
  [[nodiscard]] std::size_t stride(int axis) const;

  glm::ivec3 size_;
  double sigma_;
  double middle_ = 0.0;           ///< of a kernel of weight 1
  std::vector<glm::vec4> nodes_;  ///< weights, after the colours times them
};

/// The nodes that reach a coordinate, both ends included; not clipped to the grid.
struct Reached {
  Reached(double at, double reach);
  int first;
  int last;
};

}  // namespace relief::volume_truth
