#include "renderer/volume/kernels/clip_kernels.h"

#include "common/volume/clip_box.h"

namespace relief {
namespace {

/// Keeps the elements of the kernels that stay. An array of fewer elements is that of all kernels.
template <class T>
void keep(const std::vector<std::uint8_t>& stays, std::vector<T>& array) {
  if (array.size() != stays.size()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < stays.size(); ++k) {
    if (stays[k] != 0) array[kept++] = array[k];
  }
  array.resize(kept);
}

}  // namespace

void clip_kernels(KernelCloud& cloud, const Bounds& box) {
  std::vector<std::uint8_t> stays(cloud.count());
  for (std::size_t k = 0; k < stays.size(); ++k) stays[k] = holds(box, cloud.centres[k]) ? 1 : 0;
  if (cloud.weight == KernelWeight::Peak) {
    for (std::size_t k = 0; k < stays.size(); ++k) {
      if (stays[k] == 0) cloud.weights[k] = 0.0F;
    }
    return;
  }
  // One variance is that of all kernels, also if it is the only one's.
  if (cloud.variances.size() > 1) keep(stays, cloud.variances);
  keep(stays, cloud.weights);
  keep(stays, cloud.colours);
  keep(stays, cloud.normals);
  keep(stays, cloud.is_surface);
  keep(stays, cloud.nodes);
  keep(stays, cloud.centres);
}

}  // namespace relief
