#include "renderer/engines/surfel/surfel_set.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "common/is_finite.h"
#include "renderer/surfels/surfels.h"
#include "renderer/surfels/texture_frames.h"

namespace relief::surfel {
namespace {

/// What a surfel is made of, in the order of the cloud's points.
struct Unsorted {
  std::vector<std::uint32_t> points;
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<double> radii;
  std::vector<SurfelFrame> frames;
  std::vector<glm::mat2> gradients;  ///< world units
};

/// The values at these indices.
template <class T>
std::vector<T> picked(const std::vector<T>& from, std::span<const std::uint32_t> indices) {
  std::vector<T> values;
  values.reserve(indices.size());
  for (const std::uint32_t k : indices) values.push_back(from[k]);
  return values;
}

/// The points that have a plane.
Unsorted find_points(const SplatCloud& cloud) {
  Unsorted found;
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    const double length = glm::length(glm::dvec3(cloud.normals[k]));
    if (!is_finite(cloud.positions[k]) || !std::isfinite(length) || !(length > 0.0)) continue;
    found.points.push_back(static_cast<std::uint32_t>(k));
    found.positions.push_back(cloud.positions[k]);
    found.normals.emplace_back(glm::dvec3(cloud.normals[k]) / length);
  }
  return found;
}

/// Gives them their radii, and leaves out those that have none.
Status size_points(const SplatCloud& cloud, const SurfelSettings& settings, bool clipped,
                   Progress& progress, Unsorted& found) {
  const double scale = settings.scale.value_or(closing_scale(settings.size));
  if (settings.size == SurfelSize::Given) {
    for (const std::uint32_t k : found.points) found.radii.push_back(scale * cloud.radii[k]);
  } else {
    const std::span<const glm::vec3> normals(found.normals.data(),
                                             clipped ? found.normals.size() : 0);
    RELIEF_TRY_ASSIGN(const SurfelSizes sizes,
                      find_surfel_sizes(found.positions, normals, settings.size, progress));
    for (const double diameter : sizes.diameters) found.radii.push_back(0.5 * scale * diameter);
  }
  std::vector<std::uint32_t> good;
  for (std::uint32_t k = 0; k < found.radii.size(); ++k) {
    if (found.radii[k] > 0.0 && found.radii[k] <= kLargestRadius) good.push_back(k);
  }
  found.points = picked(found.points, good);
  found.positions = picked(found.positions, good);
  found.normals = picked(found.normals, good);
  found.radii = picked(found.radii, good);
  return {};
}

/// The bend in radii, no steeper than kSteepestRim.
glm::vec3 bend_of(const SurfelFrame& frame, double radius) {
  const glm::vec3 bend(radius * frame.bend);
  const float slope = rim_slope(bend);
  if (!std::isfinite(slope)) return glm::vec3(0.0F);
  return slope > kSteepestRim ? bend * (kSteepestRim / slope) : bend;
}

Result<SphereTree> build_tree(const Unsorted& found, Progress& progress) {
  std::vector<double> reaches;
  std::vector<float> spreads;
  for (std::size_t k = 0; k < found.points.size(); ++k) {
    reaches.push_back(double{kBentReach} * found.radii[k]);
    spreads.push_back(std::atan(rim_slope(bend_of(found.frames[k], found.radii[k]))));
  }
  return build_sphere_tree({found.positions, found.normals, reaches, spreads}, progress);
}

void add_surfel(const Unsorted& found, std::uint32_t k, SurfelSet& set) {
  const auto radius = static_cast<float>(found.radii[k]);
  const SurfelFrame& frame = found.frames[k];
  set.points.push_back(found.points[k]);
  set.positions.push_back(found.positions[k]);
  set.normals.push_back(found.normals[k]);
  set.radii.push_back(radius);
  set.axes.push_back({radius * glm::vec3(frame.u), radius * glm::vec3(frame.v)});
  set.bends.push_back(bend_of(frame, found.radii[k]));
  if (!found.gradients.empty()) set.gradients.push_back(radius * found.gradients[k]);
  const double reach = double{kBentReach} * found.radii[k];
  extend(set.bounds, found.positions[k] - reach);
  extend(set.bounds, found.positions[k] + reach);
}

/// Axes at right angles to a normal and each other, as long as the radius.
Axes axes_about(glm::vec3 normal, float radius) {
  const glm::vec3 away = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 u = glm::normalize(glm::cross(away, normal));
  return {radius * u, radius * glm::cross(normal, u)};
}

void add_mean(const SphereNode& node, SurfelSet& set) {
  const auto radius = static_cast<float>(std::clamp(node.mean_radius, 1e-30, kLargestRadius));
  set.points.push_back(set.points[node.first]);
  set.positions.push_back(node.mean);
  set.normals.push_back(node.axis);
  set.radii.push_back(radius);
  set.axes.push_back(axes_about(node.axis, radius));
  set.bends.emplace_back(0.0F);
  if (!set.gradients.empty()) set.gradients.emplace_back(0.0F);
}

}  // namespace

float rim_slope(glm::vec3 bend) {
  return std::max(std::abs(bend.x), std::abs(bend.z)) + std::abs(bend.y);
}

Result<SurfelSet> make_surfel_set(const SplatCloud& cloud, const SurfelSettings& settings,
                                  bool clipped, Progress& progress) {
  Unsorted found = find_points(cloud);
  RELIEF_TRY(size_points(cloud, settings, clipped, progress, found));
  RELIEF_TRY_ASSIGN(found.frames,
                    find_surfel_frames(found.positions, found.normals, found.radii, progress));
  if (cloud.texture != nullptr && !cloud.texcoords.empty()) {
    RELIEF_TRY_ASSIGN(found.gradients,
                      find_texture_gradients(found.positions, picked(cloud.texcoords, found.points),
                                             found.frames, found.radii, progress));
  }
  SurfelSet set;
  RELIEF_TRY_ASSIGN(set.tree, build_tree(found, progress));
  set.own = found.points.size();
  for (const std::uint32_t k : set.tree.order) add_surfel(found, k, set);
  for (const SphereNode& node : set.tree.nodes) add_mean(node, set);
  if (!cloud.colours.empty()) {
    const std::vector<glm::vec4> colours = picked(cloud.colours, found.points);
    set.colours = picked(colours, set.tree.order);
    const auto means = mean_by_node(set.tree, std::span<const glm::vec4>(colours));
    set.colours.insert(set.colours.end(), means.begin(), means.end());
  }
  return set;
}

}  // namespace relief::surfel
