#include "renderer/volume/volume_kernels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "renderer/volume/volume_nodes.h"

namespace relief {
namespace {

void add(KernelCloud& cloud, glm::dvec3 centre, double weight, glm::vec3 colour, glm::vec3 normal,
         std::size_t node) {
  cloud.centres.push_back(centre);
  cloud.weights.push_back(static_cast<float>(weight));
  cloud.colours.push_back(colour);
  cloud.normals.push_back(normal);
  cloud.nodes.push_back(static_cast<std::uint32_t>(node));
}

/// Gives the kernel that was added last a variance of its own.
void shape(KernelCloud& cloud, const Variance& variance, bool is_surface) {
  cloud.variances.push_back(variance);
  cloud.is_surface.push_back(is_surface ? 1 : 0);
}

Variance node_variance(const glm::dmat3& step, double sigma) {
  return variance_of(sigma * sigma * step * glm::transpose(step));
}

/// Flattens the kernel of a node across a unit normal: what is left lies in the tangent plane.
Variance flattened(const glm::dmat3& step, glm::dvec3 normal, double sigma) {
  const glm::dmat3 in_plane = glm::dmat3(1.0) - glm::outerProduct(normal, normal);
  const glm::dmat3 flat = in_plane * step;
  const double spacing = std::cbrt(std::abs(glm::determinant(step)));
  return variance_of(sigma * sigma * (flat * glm::transpose(flat)) +
                     kFlatVariance * spacing * spacing * glm::outerProduct(normal, normal));
}

/// What is the same for all nodes.
struct Classifier {
  const VolumeNodes& nodes;
  const TransferFunction& function;
  const VolumeSettings& settings;
  std::optional<double> iso_depth;  ///< optical depth of the surface, seen from the front

  /// Whether all kernels are alike but for their places.
  [[nodiscard]] bool is_uniform() const { return nodes.is_regular() && !iso_depth; }

  void classify(glm::uvec3 node, KernelCloud& into) const {
    const double value = nodes.value(node);
    if (std::isnan(value)) return;
    const bool is_clear = is_transparent_at(function, value);
    if (is_clear && !iso_depth) return;
    const glm::dvec3 gradient = nodes.gradient(node);
    const double magnitude = glm::length(gradient);
    const glm::dvec3 normal = magnitude > 0.0 ? -gradient / magnitude : glm::dvec3(0.0);
    const glm::dmat3 step = nodes.step(node);
    const double space = std::abs(glm::determinant(step));
    if (!(space > 0.0) || !std::isfinite(space)) return;
    const glm::dvec3 position = nodes.position(node);
    const double sigma = settings.kernel_sigma;
    if (!is_clear) {
      const double weight = extinction_at(function, value, magnitude) * space;
      if (static_cast<float>(weight) > 0.0F) {
        add(into, position, weight, colour_at(function, value), glm::vec3(normal),
            nodes.index(node));
        if (!is_uniform()) shape(into, node_variance(step, sigma), false);
      }
    }
    if (!iso_depth || !(magnitude > 0.0)) return;
    // The layer is as thick as the grid's step across the surface.
    const double thickness = kIsoLayer * glm::length(glm::transpose(step) * normal);
    const double off = (*settings.iso - value) / magnitude;
    if (!(off >= -0.5 * thickness && off < 0.5 * thickness)) return;
    add(into, position - off * normal, *iso_depth * space / thickness,
        colour_at(function, *settings.iso), glm::vec3(normal), nodes.index(node));
    shape(into, flattened(step, normal, sigma), true);
  }
};

/// One array of all planes; theirs are emptied.
template <class T>
void join(std::vector<KernelCloud>& planes, std::vector<T> KernelCloud::*array, KernelCloud& into) {
  std::size_t count = 0;
  for (const KernelCloud& plane : planes) count += (plane.*array).size();
  std::vector<T>& all = into.*array;
  all.reserve(count);
  for (KernelCloud& plane : planes) {
    all.insert(all.end(), (plane.*array).begin(), (plane.*array).end());
    std::vector<T>().swap(plane.*array);
  }
}

KernelCloud joined(std::vector<KernelCloud>& planes) {
  KernelCloud all;
  join(planes, &KernelCloud::centres, all);
  join(planes, &KernelCloud::variances, all);
  join(planes, &KernelCloud::weights, all);
  join(planes, &KernelCloud::colours, all);
  join(planes, &KernelCloud::normals, all);
  join(planes, &KernelCloud::is_surface, all);
  join(planes, &KernelCloud::nodes, all);
  return all;
}

/// The directions across the planes of equal i, j and k, in the middle of the grid.
glm::dmat3 across_planes(const VolumeNodes& nodes) {
  const glm::dmat3 step = nodes.step(nodes.volume().size / 2U);
  glm::dmat3 across(1.0);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3 normal = glm::cross(step[(axis + 1) % 3], step[(axis + 2) % 3]);
    const double side = glm::dot(normal, step[axis]) < 0.0 ? -1.0 : 1.0;
    const double length = glm::length(normal);
    if (length > 0.0) across[axis] = side * normal / length;
  }
  return across;
}

}  // namespace

KernelCloud kernels_of_volume(const ScalarVolume& volume, const TransferFunction& function,
                              const VolumeSettings& settings, const Progress& progress) {
  const VolumeNodes nodes(volume);
  Classifier classifier{nodes, function, settings, {}};
  if (settings.iso)
    classifier.iso_depth = -std::log1p(-std::min(settings.iso_opacity, kMaxOpacity));
  std::vector<KernelCloud> planes(volume.size.z);
  tbb::parallel_for(std::uint32_t{0}, volume.size.z, [&](std::uint32_t k) {
    if (progress.cancelled()) return;
    for (std::uint32_t j = 0; j < volume.size.y; ++j) {
      for (std::uint32_t i = 0; i < volume.size.x; ++i) classifier.classify({i, j, k}, planes[k]);
    }
  });
  KernelCloud all = joined(planes);
  if (classifier.is_uniform())
    all.variances = {node_variance(nodes.step(glm::uvec3(0)), settings.kernel_sigma)};
  all.size = volume.size;
  all.across = across_planes(nodes);
  return all;
}

}  // namespace relief
