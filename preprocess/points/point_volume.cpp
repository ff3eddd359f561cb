#include "preprocess/points/point_volume.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "common/neighbours/neighbours.h"

namespace relief {
namespace {

/// Bytes a point: its position and value, 32 neighbours and their tree, its kernel and its place in
/// an image.
constexpr std::uint64_t kBytesOfPoint = 640;

/// As of grids: its square and its cube are numbers.
constexpr double kLargestCoordinate = 1e30;

/// Added to the neighbours' second moments, as a share of their mean: where all lie in a plane, the
/// gradient does, too.
constexpr double kFlatNeighbours = 1e-3;

bool has_far_points(const std::vector<glm::dvec3>& positions) {
  return std::ranges::any_of(positions, [](glm::dvec3 p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate;
  });
}

std::uint64_t points_in_half_of_memory() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2 / kBytesOfPoint;
}

/// The cube root of the share of space that the ball to the farthest neighbour gives a point.
double own_spacing(const std::vector<glm::dvec3>& positions, std::size_t point,
                   std::span<const std::uint32_t> neighbours) {
  const glm::dvec3 own = positions[point];
  const auto count = static_cast<double>(neighbours.size());
  glm::dvec3 mean(0.0);
  for (const std::uint32_t n : neighbours) mean += (positions[n] - own) / count;
  const double radius = glm::distance(positions[neighbours.back()], own);
  if (!(radius > 0.0) || !std::isfinite(radius)) return 0.0;
  // The farthest one lies on the sphere: half of it is inside; the point itself is, too.
  const double spacing = radius * std::cbrt(4.0 / 3.0 * std::numbers::pi / (count + 0.5));
  // The mean of half a ball is 3/8 of the radius off its middle, that of a quarter sqrt(2) times as
  // far, of an eighth sqrt(3) times: each halves the share. By chance it is off by sqrt(3 / 5k).
  const double off = glm::length(mean) / (0.375 * radius);
  const double halves = std::max(off * off - 0.6 / (0.375 * 0.375 * count), 0.0);
  return spacing * std::exp2(-halves / 3.0);
}

/// The gradient of the linear function that fits the neighbours that have a value best. 0 where
/// there are none.
glm::dvec3 fitted_gradient(const std::vector<glm::dvec3>& positions,
                           const std::vector<float>& values, std::size_t point,
                           std::span<const std::uint32_t> neighbours) {
  const double own = values[point];
  const double radius = glm::distance(positions[neighbours.back()], positions[point]);
  if (std::isnan(own) || !(radius > 0.0) || !std::isfinite(radius)) return glm::dvec3(0.0);
  glm::dmat3 moments(0.0);
  glm::dvec3 changes(0.0);
  for (const std::uint32_t n : neighbours) {
    const double value = values[n];
    if (std::isnan(value)) continue;
    const glm::dvec3 d = (positions[n] - positions[point]) / radius;
    moments += glm::outerProduct(d, d);
    changes += (value - own) * d;
  }
  const double trace = moments[0].x + moments[1].y + moments[2].z;
  if (!(trace > 0.0)) return glm::dvec3(0.0);
  moments += glm::dmat3(kFlatNeighbours * trace / 3.0);
  const glm::dvec3 gradient = glm::inverse(moments) * changes / radius;
  return std::isfinite(glm::dot(gradient, gradient)) ? gradient : glm::dvec3(0.0);
}

/// Each point's neighbours' mean spacing, its own included.
std::vector<float> mean_spacings(const NeighbourGraph& graph, const std::vector<float>& spacings) {
  std::vector<float> means(spacings.size());
  tbb::parallel_for(std::size_t{0}, spacings.size(), [&](std::size_t p) {
    double sum = spacings[p];
    for (const std::uint32_t n : graph.of(p)) sum += static_cast<double>(spacings[n]);
    means[p] = static_cast<float>(sum / (graph.k + 1.0));
  });
  return means;
}

/// Bounds each point's spacing by those of its neighbours without it.
void bound_spacings(const NeighbourGraph& graph, std::vector<float>& spacings) {
  const std::vector<float> before = spacings;
  tbb::parallel_for(std::size_t{0}, spacings.size(), [&](std::size_t p) {
    double sum = 0.0;
    for (const std::uint32_t n : graph.of(p)) sum += static_cast<double>(before[n]);
    spacings[p] = std::min(spacings[p], static_cast<float>(kMostOfMean * sum / graph.k));
  });
}

std::vector<float> values_of(std::vector<double> scalar) {
  std::vector<float> values;
  values.reserve(scalar.size());
  for (const double value : scalar) values.push_back(static_cast<float>(value));
  return values;
}

}  // namespace

Result<ScalarVolume> volume_of_points(Points points, std::string_view scalar, Progress& progress) {
  const auto found = std::ranges::find(points.scalars, scalar, &PointScalar::name);
  assert(found != points.scalars.end() && "the points have the scalar");
  const std::size_t count = points.size();
  if (count < kMinVolumePoints) {
    return make_error("the scan has {} distinct points; a volume needs at least {}", count,
                      kMinVolumePoints);
  }
  if (count > points_in_half_of_memory()) {
    return make_error(
        "a volume of its {} points would take more than half of this machine's memory; read fewer "
        "with --crop",
        count);
  }
  if (has_far_points(points.positions)) {
    return make_error("some of its coordinates are beyond {:g}; read fewer points with --crop",
                      kLargestCoordinate);
  }
  ScalarVolume volume;
  volume.size = {static_cast<std::uint32_t>(count), 1, 1};
  volume.values = values_of(std::move(found->values));
  volume.stance = stance_of(points);
  ScatteredPoints scattered;
  scattered.positions = std::move(points.positions);
  progress.begin_stage("neighbours", 0);
  const NeighbourGraph graph = find_neighbours(scattered.positions, kSpaceNeighbours);
  if (progress.cancelled()) return interrupted_error();
  scattered.spacings.resize(count);
  scattered.gradients.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
    if (progress.cancelled()) return;
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      scattered.spacings[p] = static_cast<float>(own_spacing(scattered.positions, p, graph.of(p)));
      scattered.gradients[p] =
          glm::vec3(fitted_gradient(scattered.positions, volume.values, p, graph.of(p)));
    }
  });
  if (progress.cancelled()) return interrupted_error();
  bound_spacings(graph, scattered.spacings);
  scattered.widths = mean_spacings(graph, scattered.spacings);
  volume.placement = std::move(scattered);
  return volume;
}

}  // namespace relief
