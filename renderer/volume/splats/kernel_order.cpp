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

/// The sheets along an axis by their distance from the eye: each one's place in that order.
std::vector<std::uint32_t> rank_sheets(const KernelCloud& cloud, glm::length_t axis,
                                       const RayCamera& camera) {
  const std::size_t sheets = cloud.size[axis];
  std::vector<double> sums(sheets, 0.0);
  std::vector<double> counts(sheets, 0.0);
  for (std::size_t k = 0; k < cloud.count(); ++k) {
    const std::uint32_t sheet = cloud.node(k)[axis];
    sums[sheet] += glm::dot(cloud.centres[k] - camera.eye, cloud.across[axis]);
    counts[sheet] += 1.0;
  }
  const double forward = (camera.rotation * cloud.across[axis]).z;
  std::vector<double> distances(sheets, 0.0);
  for (std::size_t s = 0; s < sheets; ++s) {
    if (counts[s] == 0.0) continue;
    const double along = sums[s] / counts[s];
    distances[s] = camera.orthographic ? along * (forward < 0.0 ? -1.0 : 1.0) : std::abs(along);
  }
  std::vector<std::uint32_t> sorted(sheets);
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distances[a] < distances[b]; });
  std::vector<std::uint32_t> ranks(sheets);
  for (std::uint32_t rank = 0; rank < sheets; ++rank) ranks[sorted[rank]] = rank;
  return ranks;
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

KernelOrder order_by_sheets(const KernelCloud& cloud, const RayCamera& camera) {
  const glm::length_t axis = sheet_axis(cloud, camera);
  const std::vector<std::uint32_t> ranks = rank_sheets(cloud, axis, camera);
  KernelOrder order;
  order.starts.assign(ranks.size() + 1, 0);
  for (std::size_t k = 0; k < cloud.count(); ++k) ++order.starts[ranks[cloud.node(k)[axis]] + 1];
  std::partial_sum(order.starts.begin(), order.starts.end(), order.starts.begin());
  order.kernels.resize(cloud.count());
  std::vector<std::uint32_t> next(order.starts.begin(), order.starts.end() - 1);
  for (std::size_t k = 0; k < cloud.count(); ++k)
    order.kernels[next[ranks[cloud.node(k)[axis]]]++] = static_cast<std::uint32_t>(k);
  return order;
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
