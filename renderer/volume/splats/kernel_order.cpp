#include "renderer/volume/splats/kernel_order.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace relief {
namespace {

/// Sheets by their distance from the eye, nearest first.
std::vector<std::uint32_t> sort_sheets(const KernelSheets& sheets, const RayCamera& camera) {
  const double forward = (camera.rotation * sheets.across).z;
  const double eye = glm::dot(camera.eye, sheets.across);
  std::vector<double> distances(sheets.count());
  for (std::size_t s = 0; s < sheets.count(); ++s) {
    const double along = sheets.places[s] - eye;
    distances[s] = camera.orthographic ? along * (forward < 0.0 ? -1.0 : 1.0) : std::abs(along);
  }
  std::vector<std::uint32_t> sorted(sheets.count());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distances[a] < distances[b]; });
  return sorted;
}

}  // namespace

glm::length_t sheet_axis(const KernelCloud& cloud, const RayCamera& camera) {
  glm::length_t best = 0;
  double most = -1.0;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const double along = std::abs((camera.rotation * cloud.across[axis]).z);
    if (along > most) {
      most = along;
      best = axis;
    }
  }
  return best;
}

KernelSheets find_sheets(const KernelCloud& cloud, glm::length_t axis) {
  KernelSheets sheets;
  sheets.across = cloud.across[axis];
  const std::size_t count = cloud.size[axis];
  sheets.places.assign(count, 0.0);
  sheets.starts.assign(count + 1, 0);
  for (std::size_t k = 0; k < cloud.count(); ++k) {
    const std::uint32_t sheet = cloud.node(k)[axis];
    sheets.places[sheet] += glm::dot(cloud.centres[k], sheets.across);
    ++sheets.starts[sheet + 1];
  }
  for (std::size_t s = 0; s < count; ++s)
    sheets.places[s] /= std::max<double>(sheets.starts[s + 1], 1.0);
  std::partial_sum(sheets.starts.begin(), sheets.starts.end(), sheets.starts.begin());
  sheets.kernels.resize(cloud.count());
  std::vector<std::uint32_t> next(sheets.starts.begin(), sheets.starts.end() - 1);
  for (std::size_t k = 0; k < cloud.count(); ++k)
    sheets.kernels[next[cloud.node(k)[axis]]++] = static_cast<std::uint32_t>(k);
  return sheets;
}

KernelOrder order_by_sheets(const KernelSheets& sheets, const RayCamera& camera) {
  KernelOrder order;
  order.kernels.reserve(sheets.kernels.size());
  order.starts.assign(1, 0);
  for (const std::uint32_t s : sort_sheets(sheets, camera)) {
    order.kernels.insert(order.kernels.end(), sheets.kernels.begin() + sheets.starts[s],
                         sheets.kernels.begin() + sheets.starts[s + 1]);
    order.starts.push_back(static_cast<std::uint32_t>(order.kernels.size()));
  }
  return order;
}

KernelOrder order_by_sheets(const KernelCloud& cloud, const RayCamera& camera) {
  return order_by_sheets(find_sheets(cloud, sheet_axis(cloud, camera)), camera);
}

KernelOrder order_by_depth(const KernelCloud& cloud, const RayCamera& camera) {
  std::vector<std::pair<double, std::uint32_t>> keys(cloud.count());
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t k) {
    keys[k] = {to_camera(camera, cloud.centres[k]).z, static_cast<std::uint32_t>(k)};
  });
  tbb::parallel_sort(keys.begin(), keys.end());
  KernelOrder order;
  order.kernels.reserve(keys.size());
  for (const auto& [depth, kernel] : keys) order.kernels.push_back(kernel);
  order.starts.resize(keys.size() + 1);
  std::iota(order.starts.begin(), order.starts.end(), 0U);
  return order;
}

}  // namespace relief
