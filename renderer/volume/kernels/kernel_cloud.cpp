#include "renderer/volume/kernels/kernel_cloud.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace relief {
namespace {

/// Appends an attribute of `count` kernels, which only some clouds have, behind `before` of others.
template <class T>
void append_attribute(std::vector<T>& to, const std::vector<T>& from, std::size_t before,
                      std::size_t count) {
  if (to.empty() && from.empty()) return;
  to.resize(before, T(0));
  to.insert(to.end(), from.begin(), from.end());
  to.resize(before + count, T(0));
}

}  // namespace

KernelCloud merged(std::vector<KernelCloud> clouds) {
  assert(!clouds.empty());
  if (clouds.size() == 1) return std::move(clouds.front());
  KernelCloud all;
  const bool are_peaks = std::all_of(clouds.begin(), clouds.end(), [](const KernelCloud& cloud) {
    return cloud.weight == KernelWeight::Peak;
  });
  all.weight = are_peaks ? KernelWeight::Peak : KernelWeight::Integral;
  for (KernelCloud& cloud : clouds) {
    const std::size_t before = all.count();
    const std::size_t count = cloud.count();
    all.starts.push_back(before);
    append_attribute(all.colours, cloud.colours, before, count);
    append_attribute(all.normals, cloud.normals, before, count);
    append_attribute(all.is_surface, cloud.is_surface, before, count);
    all.centres.insert(all.centres.end(), cloud.centres.begin(), cloud.centres.end());
    all.weights.insert(all.weights.end(), cloud.weights.begin(), cloud.weights.end());
    if (cloud.variances.size() == 1 && count != 1)
      all.variances.insert(all.variances.end(), count, cloud.variances.front());
    else
      all.variances.insert(all.variances.end(), cloud.variances.begin(), cloud.variances.end());
    cloud = {};
  }
  return all;
}

}  // namespace relief
