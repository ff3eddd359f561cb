// In which order kernels occlude one another, before it is known where they are in the image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief {

/// All kernels of a cloud in groups, front to back: those of a group add up and occlude the next
/// ones as one layer.
struct KernelOrder {
  std::vector<std::uint32_t> kernels;
  std::vector<std::uint32_t> starts;  ///< of each group in `kernels`, and the end

  [[nodiscard]] std::size_t groups() const { return starts.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> group(std::size_t g) const {
    return std::span(kernels).subspan(starts[g], starts[g + 1] - starts[g]);
  }
};

/// The grid's axis whose planes are most parallel to the image.
[[nodiscard]] glm::length_t sheet_axis(const KernelCloud& cloud, const RayCamera& camera);

/// A grid's sheets across an axis, whatever the view.
struct KernelSheets {
  glm::dvec3 across{0.0};
  std::vector<std::uint32_t> kernels;
  std::vector<std::uint32_t> starts;  ///< of each sheet in `kernels`, and the end
  std::vector<double> places;         ///< of each: the mean of centre . across

  [[nodiscard]] std::size_t count() const { return places.size(); }
};

[[nodiscard]] KernelSheets find_sheets(const KernelCloud& cloud, glm::length_t axis);

/// Sheets by their distance from the eye along the axis: a ray meets those of one side only, in
/// this order. A group may be empty.
[[nodiscard]] KernelOrder order_by_sheets(const KernelSheets& sheets, const RayCamera& camera);
/// Those across sheet_axis().
[[nodiscard]] KernelOrder order_by_sheets(const KernelCloud& cloud, const RayCamera& camera);

/// One kernel after the other, by the depth of the centre. Equals keep the cloud's order.
[[nodiscard]] KernelOrder order_by_depth(const KernelCloud& cloud, const RayCamera& camera);

}  // namespace relief
