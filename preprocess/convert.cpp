#include "preprocess/convert.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "common/background_tasks.h"
#include "common/guard.h"
#include "common/mesh/mesh_normals.h"
#include "common/seams/join_normals.h"
#include "common/seams/make_seams.h"
#include "preprocess/convert_stages.h"
#include "preprocess/measure.h"
#include "preprocess/mesh_fit/fit_to_mesh.h"
#include "preprocess/normals/closed_mesh.h"
#include "preprocess/normals/normals.h"
#include "preprocess/partition/find_regions.h"
#include "preprocess/points/densify.h"
#include "preprocess/points/neighbours.h"
#include "preprocess/resample/region_patches.h"
#include "preprocess/resample/spacing/error_spacing.h"
#include "preprocess/resample/spacing/patch_spacing.h"
#include "preprocess/texture/files/load_textures.h"
#include "preprocess/texture/maps/flat_triangles.h"
#include "preprocess/texture/maps/node_normals.h"
#include "preprocess/texture/maps/texture_maps.h"
#include "preprocess/thread_limit.h"

namespace relief {
namespace {

// Points on one line span no surface: the second principal variance vanishes beside the first.
bool on_one_line(const std::vector<glm::dvec3>& positions, const Bounds& bounds) {
  const glm::dvec3 base = (bounds.min + bounds.max) / 2.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const glm::dvec3& p : positions) {
    const Eigen::Vector3d d(p.x - base.x, p.y - base.y, p.z - base.z);
    mean += d;
    moments += d * d.transpose();
  }
  const auto count = static_cast<double>(positions.size());
  mean /= count;
  const Eigen::Matrix3d covariance = moments / count - mean * mean.transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return !(values[1] > 1e-12 * values[2]);
}

Status check_points(const std::vector<glm::dvec3>& positions) {
  if (positions.size() < kMinSurfacePoints) {
    return make_error(
        "the scan has {} distinct points; at least {} are needed to reconstruct a surface",
        positions.size(), kMinSurfacePoints);
  }
  if (on_one_line(positions, bounds_of(positions))) {
    return make_error("all {} points lie on one line and span no surface", positions.size());
  }
  return {};
}

// The area of all regions, estimated from their points' local spacings.
double area_of(const std::vector<Region>& regions, const SurfaceSamples& samples) {
  double area = 0.0;
  for (const Region& region : regions) {
    for (const std::uint32_t i : region.points)
      area += double{samples.spacing[i]} * samples.spacing[i];
  }
  return area;
}

/// How many samples there are by default, and each patch's share.
SampleBudget budget_of(const SurfaceSamples& samples, const std::vector<Region>& regions,
                       std::size_t points, const ConvertOptions& options, bool seams,
                       bool is_mesh) {
  SampleBudget budget{std::vector<double>(regions.size(), 1.0), usual_samples(points, seams)};
  if (options.adaptive_spacing)
    budget.factors = spacing_factors(samples, regions);
  else if (seams && is_mesh && !(options.spacing > 0.0))
    budget = share_samples(samples, regions, points);
  return budget;
}

/// Properties of a mesh's triangles, computed in the background: the edges and the kd-tree take one
/// thread each.
class MeshInTime {
 public:
  /// Computes nothing for a mesh without triangles. The first `given` points are the file's.
  /// Positions and triangles must not change, nor normals until `wait`.
  MeshInTime(const Points& mesh, std::size_t given) {
    if (mesh.triangles.empty()) return;
    tasks_.run([this, &mesh] { spheres_.emplace(mesh); });
    tasks_.run([this, &mesh, given] {
      const MeshEdges edges(mesh);
      is_closed_ = is_closed_mesh(mesh, given, edges);
      is_borderless_ = is_borderless_mesh(mesh, given, edges);
      normals_ = normals_of_faces(mesh, edges);
    });
  }
  void wait() { tasks_.wait(); }

  // After `wait`.
  [[nodiscard]] bool is_closed() const { return is_closed_; }
  [[nodiscard]] bool is_borderless() const { return is_borderless_; }
  [[nodiscard]] const std::vector<glm::vec3>& normals() const { return normals_; }
  [[nodiscard]] const TriangleSpheres& spheres() const { return *spheres_; }

 private:
  bool is_closed_ = false;
  bool is_borderless_ = false;
  std::vector<glm::vec3> normals_;
  std::optional<TriangleSpheres> spheres_;
  BackgroundTasks tasks_;
};

// Textures are finer than the vertices that carry them.
constexpr std::size_t kTexturedPoints = 70'000;
constexpr double kMostTexturedPoints = 2e6;

/// How many points a textured mesh shall have: more if the spacing (world units; 0: none) asks for
/// them.
std::size_t least_points(const Points& mesh, double spacing) {
  if (!(spacing > 0.0)) return kTexturedPoints;
  const double wanted = area_of_triangles(mesh) / (spacing * spacing);
  return std::max(kTexturedPoints, static_cast<std::size_t>(std::min(wanted, kMostTexturedPoints)));
}

/// Fits patches that meet to the mesh; others take its normals alone.
void take_mesh(const Points& mesh, const TriangleSpheres& spheres, bool seams,
               std::vector<Patch>& patches, Progress& progress) {
  progress.begin_stage("fit to triangles", patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    if (seams)
      fit_to_mesh(mesh, mesh.normals, spheres, patches[p]);
    else
      take_mesh_normals(mesh, mesh.normals, spheres.find_over(patches[p]), patches[p]);
    progress.advance(1);
  });
}

/// Measures the first `count` points against the patches, and joins normals of those that meet.
Fidelity measure(const std::vector<glm::dvec3>& positions, std::size_t count,
                 const NeighbourGraph& graph, const std::vector<std::uint32_t>& owner,
                 PatchModel& model) {
  std::vector<double> distances;
  std::optional<SeamDistances> seams;
  // Stitching takes mostly one thread. It reads no normals of holes, which are what is joined.
  tbb::parallel_invoke(
      [&] {
        if (!model.joined.empty())
          seams.emplace(model.patches, make_seams(model.patches, model.joined.front().is_closed));
      },
      [&] {
        distances = distances_to_patches(positions, count, graph, owner, model.patches);
        join_normals(model);
      });
  if (seams) compare_with_seams(positions, model.patches, *seams, distances);
  return measure_fidelity(positions, distances, model.patches);
}

/// Adds points where triangles are large. Fails if a textured mesh has no area that they could lie
/// on.
Status add_points(Points& points, bool textured, double spacing, ConvertReport& report) {
  if (textured) points.normals = vertex_normals(points);
  report.points_added = densify_triangles(points, textured ? least_points(points, spacing) : 0);
  if (textured && points.size() < kMinSurfacePoints)
    return make_error("the triangles have no area that points could be spread over");
  return {};
}

Result<ConvertResult> convert_in_arena(Points& points, const ConvertOptions& options,
                                       Progress& progress) {
  ConvertResult result;
  const bool textured = has_triangle_colours(points);
  const bool seams = options.seams.value_or(!points.triangles.empty());
  result.report.points = points.size();
  RELIEF_TRY(add_points(points, textured, options.spacing, result.report));

  MeshInTime in_time(points, points.size() - result.report.points_added);
  progress.begin_stage("neighbours", 0);
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return interrupted_error();

  progress.begin_stage("normals", 0);
  const LocalFrames frames = fit_local_frames(points.positions, graph);
  in_time.wait();
  result.model.is_closed = in_time.is_closed();
  const NormalsReport normals = complete_normals(points, graph, frames, &in_time.normals());
  result.report.normals_estimated = normals.estimated;
  result.report.normals_repaired = normals.repaired;
  if (progress.cancelled()) return interrupted_error();

  std::optional<CreaseNormals> creases;
  if (seams) creases = find_creases(points.positions, points.normals, graph);
  std::vector<Region> regions =
      find_regions(points, points.size(), graph, frames, options.cone_degrees,
                   creases ? &*creases : nullptr, progress);
  if (progress.cancelled()) return interrupted_error();

  const SurfaceSamples samples{points.positions, points.normals, graph.spacing, frames.roughness};
  const std::size_t wanted = textured ? points.size() : result.report.points;
  const SampleBudget budget =
      budget_of(samples, regions, wanted, options, seams, !points.triangles.empty());
  const double spacing =
      options.spacing > 0.0
          ? options.spacing
          : choose_spacing(samples, graph, regions, budget.factors, budget.samples, seams);
  RELIEF_TRY(check_spacing(spacing, area_of(regions, samples), points.size()));
  const Membership membership = membership_of(samples, regions);
  std::vector<Patch> patches =
      make_patches({.samples = samples,
                    .graph = graph,
                    .membership = membership,
                    .colours = points.colours,
                    .creases = creases ? &*creases : nullptr},
                   budget.factors, resample_options(options, seams, spacing, normals.estimated),
                   regions, progress);
  if (progress.cancelled()) return interrupted_error();
  if (patches.empty()) return make_error("the points are too scattered to be a surface");

  if (!points.triangles.empty()) {
    take_mesh(points, in_time.spheres(), seams, patches, progress);
    if (progress.cancelled()) return interrupted_error();
  }
  if (textured) {
    RELIEF_TRY(map_textures(points, static_cast<std::uint32_t>(options.texels_per_cell), patches,
                            progress));
  }

  progress.begin_stage("measure", 0);
  PatchModel& model = result.model;
  model.patches = std::move(patches);
  if (seams)
    model.joined = {{0, static_cast<std::uint32_t>(model.patches.size()), in_time.is_borderless()}};
  const Fidelity fidelity =
      measure(points.positions, wanted, graph, owners_of(regions, points.size()), model);
  model.spacing = spacing;
  model.bounds = bounds_of(points.positions);
  model.bounding_radius = bounding_radius(points.positions, model.bounds);
  model.has_colours = textured || !points.colours.empty();
  count_texels(model.patches, result.report);
  result.report.error_rms = fidelity.rms;
  result.report.error_max = fidelity.max;
  result.report.uncovered_points = fidelity.uncovered;
  const double diagonal = glm::distance(model.bounds.min, model.bounds.max);
  result.report.psnr_db = 20.0 * std::log10(diagonal / fidelity.rms);
  return result;
}

}  // namespace

Result<ConvertResult> convert(Points points, const ConvertOptions& options, Progress& progress) {
  // The few vertices of a mesh with materials are not converted; its samples are.
  if (!has_triangle_colours(points)) {
    RELIEF_TRY(check_points(points.positions));
  }
  const std::string task = fmt::format("convert {} points", points.size());
  return guarded({.subject = "",
                  .task = task,
                  .advice = kReportDefect,
                  .memory_advice = "convert with --memory or with a larger --spacing"},
                 [&] {
                   return with_threads(options.threads,
                                       [&] { return convert_in_arena(points, options, progress); });
                 });
}

}  // namespace relief
