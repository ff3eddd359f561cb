#include "renderer/volume/kernels/volume_kernels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "renderer/volume/kernels/volume_nodes.h"

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

/// A node of a grid, or a point, that has a value.
struct Place {
  std::size_t node = 0;
  glm::dvec3 position{0.0};
  double value = 0.0;
  glm::dvec3 gradient{0.0};
  glm::dmat3 step{1.0};  ///< columns: to the next nodes; of a point: as far as its neighbours are
  double space = 0.0;    ///< its own share of space
};

/// What is the same for all places.
struct Classifier {
  const TransferFunction& function;
  const VolumeSettings& settings;
  std::optional<double> iso_depth;  ///< optical depth of the surface, seen from the front

  /// Whether no kernel shows what has this value.
  [[nodiscard]] bool is_hidden(double value) const {
    return std::isnan(value) || (!iso_depth && is_transparent_at(function, value));
  }

  /// `is_uniform`: all kernels are alike but for their places.
  void classify(const Place& place, bool is_uniform, KernelCloud& into) const {
    if (!(place.space > 0.0) || !std::isfinite(place.space)) return;
    const double magnitude = glm::length(place.gradient);
    const glm::dvec3 normal = magnitude > 0.0 ? -place.gradient / magnitude : glm::dvec3(0.0);
    const double sigma = settings.kernel_sigma;
    if (!is_transparent_at(function, place.value)) {
      const double weight = extinction_at(function, place.value, magnitude) * place.space;
      if (static_cast<float>(weight) > 0.0F) {
        add(into, place.position, weight, colour_at(function, place.value), glm::vec3(normal),
            place.node);
        if (!is_uniform) shape(into, node_variance(place.step, sigma), false);
      }
    }
    if (!iso_depth || !(magnitude > 0.0)) return;
    // The layer is as thick as the grid's step across the surface.
    const double thickness = kIsoLayer * glm::length(glm::transpose(place.step) * normal);
    const double off = (*settings.iso - place.value) / magnitude;
    if (!(off >= -0.5 * thickness && off < 0.5 * thickness)) return;
    add(into, place.position - off * normal, *iso_depth * place.space / thickness,
        colour_at(function, *settings.iso), glm::vec3(normal), place.node);
    shape(into, flattened(place.step, normal, sigma), true);
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

KernelCloud kernels_of_grid(const ScalarVolume& volume, const Classifier& classifier,
                            const Progress& progress) {
  const VolumeNodes nodes(volume);
  const bool is_uniform = nodes.is_regular() && !classifier.iso_depth;
  std::vector<KernelCloud> planes(volume.size.z);
  tbb::parallel_for(std::uint32_t{0}, volume.size.z, [&](std::uint32_t k) {
    if (progress.cancelled()) return;
    for (std::uint32_t j = 0; j < volume.size.y; ++j) {
      for (std::uint32_t i = 0; i < volume.size.x; ++i) {
        const glm::uvec3 node(i, j, k);
        const double value = nodes.value(node);
        if (classifier.is_hidden(value)) continue;
        const glm::dmat3 step = nodes.step(node);
        classifier.classify({nodes.index(node), nodes.position(node), value, nodes.gradient(node),
                             step, std::abs(glm::determinant(step))},
                            is_uniform, planes[k]);
      }
    }
  });
  KernelCloud all = joined(planes);
  if (is_uniform)
    all.variances = {node_variance(nodes.step(glm::uvec3(0)), classifier.settings.kernel_sigma)};
  all.size = volume.size;
  all.across = across_planes(nodes);
  return all;
}

/// Points that are classified as one piece of work.
constexpr std::size_t kPointsOfPiece = 16384;

KernelCloud kernels_of_points(const ScalarVolume& volume, const ScatteredPoints& points,
                              const Classifier& classifier, const Progress& progress) {
  const std::size_t count = points.positions.size();
  std::vector<KernelCloud> pieces((count + kPointsOfPiece - 1) / kPointsOfPiece);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t piece) {
    if (progress.cancelled()) return;
    const std::size_t end = std::min((piece + 1) * kPointsOfPiece, count);
    for (std::size_t p = piece * kPointsOfPiece; p < end; ++p) {
      const double value = volume.values[p];
      if (classifier.is_hidden(value)) continue;
      const double spacing = points.spacings[p];
      classifier.classify(
          {p, points.positions[p], value, glm::dvec3(points.gradients[p]),
           glm::dmat3(static_cast<double>(points.widths[p])), spacing * spacing * spacing},
          false, pieces[piece]);
    }
  });
  KernelCloud all = joined(pieces);
  all.nodes = {};  // without a grid there are no sheets
  return all;
}

}  // namespace

KernelCloud kernels_of_volume(const ScalarVolume& volume, const TransferFunction& function,
                              const VolumeSettings& settings, const Progress& progress) {
  Classifier classifier{function, settings, {}};
  if (settings.iso)
    classifier.iso_depth = -std::log1p(-std::min(settings.iso_opacity, kMaxOpacity));
  if (const auto* const points = std::get_if<ScatteredPoints>(&volume.placement))
    return kernels_of_points(volume, *points, classifier, progress);
  return kernels_of_grid(volume, classifier, progress);
}

}  // namespace relief
