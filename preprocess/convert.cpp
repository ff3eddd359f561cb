#include "preprocess/convert.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "common/background_tasks.h"
#include "common/guard.h"
#include "common/mesh/coarse_mesh.h"
#include "common/mesh/mesh_normals.h"
#include "common/mesh/orient_triangles.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/add_distances.h"
#include "preprocess/clean_scan.h"
#include "preprocess/coarse_scan.h"
#include "preprocess/convert_stages.h"
#include "preprocess/frame/working_frame.h"
#include "preprocess/frame/working_unit.h"
#include "preprocess/make_model.h"
#include "preprocess/meeting.h"
#include "preprocess/normals/closed_mesh.h"
#include "preprocess/normals/normals.h"
#include "preprocess/partition/find_regions.h"
#include "preprocess/partition/split_by_density.h"
#include "preprocess/points/even_out.h"
#include "preprocess/points/on_mesh/densify.h"
#include "preprocess/points/sort_in_space.h"
#include "preprocess/resample/attributes/scalars.h"
#include "preprocess/resample/spacing/patch_spacing.h"
#include "preprocess/sample_search.h"
#include "preprocess/texture/files/load_textures.h"
#include "preprocess/texture/maps/flat_triangles.h"
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

// Points farther off than this many sizes of the scan leave single precision when they are squared.
constexpr double kFarthestStray = 1e13;

/// Whether the points in the middle of the scan lie on one line: those far off do not count. Also
/// true if a point lies so far off that nothing can be computed beside it.
bool on_one_line_in_the_middle(const std::vector<glm::dvec3>& positions) {
  const Bounds bounds = bounds_of(positions);
  const double reach = kFarthestStray * working_unit(positions);
  if (!(glm::length(bounds.max - bounds.min) <= reach)) return true;
  const std::vector<glm::dvec3> middle = points_in_the_middle(positions);
  return on_one_line(middle, bounds_of(middle));
}

Status check_points(const std::vector<glm::dvec3>& positions) {
  if (positions.size() < kMinSurfacePoints) {
    return make_error(
        "the scan has {} distinct points; at least {} are needed to reconstruct a surface",
        positions.size(), kMinSurfacePoints);
  }
  // A point far enough away makes a line of any scan.
  if (on_one_line(positions, bounds_of(positions)) && on_one_line_in_the_middle(positions)) {
    return make_error("all {} points lie on one line and span no surface", positions.size());
  }
  return {};
}

/// Properties of a mesh's triangles, computed in the background: the edges and the kd-tree take one
/// thread each.
class MeshInTime {
 public:
  /// Computes nothing for a mesh without triangles. The first `given` points are the file's.
  /// `welded`: the triangles with one point a position. Positions and triangles must not change,
  /// nor normals until `wait`.
  MeshInTime(const Points& mesh, std::size_t given, std::span<const Triangle> welded) {
    if (mesh.triangles.empty()) return;
    tasks_.run([this, &mesh] { spheres_.emplace(mesh); });
    tasks_.run([this, &mesh, given, welded] {
      const MeshEdges edges(mesh.size(), welded);
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

/// How many points a scan is to have at least, so that its triangles tell where its surface is; 0:
/// those that it has. `is_moved`: its noise was removed.
std::size_t least_points_of(const Points& points, bool textured, bool is_moved, double spacing) {
  if (textured) return least_points(points, spacing);
  // Noise is measured of the points that were scanned.
  return is_moved ? 0 : least_points_of_scan(points, spacing);
}

/// Adds points where triangles are large beside the spacing of the mesh, or of `least` points.
/// Fails if a textured mesh has no area that they could lie on.
Status add_points(Points& points, bool textured, std::size_t least, ConvertReport& report) {
  if (textured || (least > 0 && orient_triangles(points))) points.normals = vertex_normals(points);
  report.points_added = densify_triangles(points, least);
  if (textured && points.size() < kMinSurfacePoints)
    return make_error("the triangles have no area that points could be spread over");
  return {};
}

/// Makes the model with as many samples as asked for.
Result<MeasuredModel> make_model_of(const PartitionedScan& scan, const ConvertOptions& options,
                                    Progress& progress) {
  const auto wanted = static_cast<double>(options.samples);
  RELIEF_TRY_ASSIGN(MeasuredModel made, make_model(scan, options, wanted, progress));
  // Margins and ragged borders are estimated. Bare points have up to 13 % more samples.
  const double share = static_cast<double>(count_samples(made.model)) / wanted;
  if (share > 0.95 && share < 1.05) return made;
  return make_model(scan, options, wanted / share, progress);
}

/// Makes the model with the fewest samples whose error is as small as asked for, if one is.
Result<MeasuredModel> make_best_model(const PartitionedScan& scan, const ConvertOptions& options,
                                      Progress& progress) {
  if (options.samples > kFinestSamplesPerPoint * static_cast<double>(scan.measured)) {
    return make_error("--samples {} is more than the points can tell; {} points tell {} at most",
                      options.samples, scan.measured,
                      static_cast<std::uint64_t>(kFinestSamplesPerPoint) * scan.measured);
  }
  if (options.samples > 0) return make_model_of(scan, options, progress);
  if (options.samples_per_point > 0.0)
    return make_model(scan, options, options.samples_per_point * static_cast<double>(scan.measured),
                      progress);
  if (!(options.error > 0.0)) return make_model(scan, options, std::nullopt, progress);
  SampleSearch search(options.error, static_cast<double>(scan.measured));
  std::optional<MeasuredModel> best;
  while (const std::optional<double> samples = search.next()) {
    RELIEF_TRY_ASSIGN(MeasuredModel made, make_model(scan, options, samples, progress));
    if (search.note(*samples, static_cast<double>(count_samples(made.model)), made.fidelity.rms))
      best = std::move(made);
  }
  if (best->fidelity.rms > options.error) {
    progress.note(fmt::format(
        "an error of {:.3g} is not reached: it is {:.3g} with {} samples a point, and more would "
        "follow the points' noise or the steps of heights",
        options.error * scan.unit, best->fidelity.rms * scan.unit, kFinestSamplesPerPoint));
  }
  return std::move(*best);
}

void report_model(const Fidelity& fidelity, const PatchModel& model, ConvertReport& report) {
  count_texels(model.patches, report);
  report.error_rms = fidelity.rms;
  report.error_max = fidelity.max;
  report.uncovered_points = fidelity.uncovered;
  const double diagonal = glm::distance(model.bounds.min, model.bounds.max);
  report.psnr_db = 20.0 * std::log10(diagonal / fidelity.rms);
  report.finest_spacing = report.coarsest_spacing = model.spacing;
  for (const Patch& patch : model.patches) {
    report.finest_spacing = std::min(report.finest_spacing, patch.spacing);
    report.coarsest_spacing = std::max(report.coarsest_spacing, patch.spacing);
  }
}

Result<ConvertResult> convert_in_unit(Points& points, const ConvertOptions& options, double unit,
                                      Progress& progress) {
  ConvertResult result;
  const bool textured = has_triangle_colours(points);
  if (points.triangles.empty()) result.report.points_merged = even_out(points, progress);
  if (progress.cancelled()) return interrupted_error();
  RELIEF_TRY_ASSIGN(CleanScan clean, drop_strays(points, options, result.report, progress));
  // As scanned, so that a camera is the same for engines that draw the points themselves.
  PatchModel extent;
  WorkingFrame frame;
  tbb::parallel_invoke([&] { set_extent(extent, points.positions); },
                       [&] { frame = working_frame(points.positions); });
  to_working_frame(frame, points);
  RELIEF_TRY(drop_noise(points, options, unit, clean, result.report, progress));
  result.report.points = points.size();
  RELIEF_TRY_ASSIGN(const std::optional<CoarseScan> coarse,
                    take_coarse_mesh(points, options.spacing, progress));
  const Points& mesh = coarse ? coarse->mesh : points;
  const std::size_t least =
      least_points_of(points, textured, !clean.scanned.empty(), options.spacing);
  if (coarse) {
    result.report.points_added = points.size();
    clean = {};
  } else {
    RELIEF_TRY(add_points(points, textured, least, result.report));
  }
  if (!clean.scanned.empty()) {
    const auto added = static_cast<std::ptrdiff_t>(result.report.points_added);
    clean.scanned.insert(clean.scanned.end(), points.positions.end() - added,
                         points.positions.end());
  }

  MeshInTime in_time(mesh, coarse ? mesh.size() : points.size() - result.report.points_added,
                     coarse ? coarse->welded : mesh.triangles);
  const MeshSides* const sides =
      coarse && coarse->has_sides && options.seams.value_or(true) ? &coarse->sides : nullptr;
  if (!clean.graph) progress.begin_stage("neighbours", 0);
  const NeighbourGraph graph =
      sides != nullptr ? find_neighbours_on_sides(points.positions, sides->of_points)
      : clean.graph    ? std::move(*clean.graph)
                       : find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return interrupted_error();

  progress.begin_stage("normals", 0);
  LocalFrames frames = fit_local_frames(points.positions, graph);
  take_known_normals(clean.normals, frames);
  in_time.wait();
  const NormalsReport normals =
      complete_normals(points, graph, frames,
                       {.side = to_working_frame(frame, options.side),
                        .of_faces = &in_time.normals(),
                        .are_of_faces = coarse && coarse->is_oriented && !coarse->has_own_normals},
                       progress);
  result.report.normals_estimated = normals.estimated;
  result.report.normals_repaired = normals.repaired;
  if (progress.cancelled()) return interrupted_error();

  const SurfaceSamples samples{points.positions, points.normals, graph.spacing, frames.roughness};
  Meeting meeting;
  if (options.seams.value_or(!mesh.triangles.empty()))
    meeting.creases = find_creases(points.positions, points.normals, graph);
  else if (!options.seams)
    meeting = choose_meeting(samples, graph);
  if (progress.cancelled()) return interrupted_error();
  std::vector<Region> regions =
      find_regions(points, points.size(), graph, frames, options.cone_degrees,
                   meeting.creases ? &*meeting.creases : nullptr, progress);
  if (progress.cancelled()) return interrupted_error();

  const bool follows_density = options.adaptive_spacing.value_or(
      mesh.triangles.empty() && !(options.spacing > 0.0) && is_uneven(samples, regions));
  if (follows_density) regions = split_by_density(samples, graph, std::move(regions));
  const std::vector<ScalarInfo> scalars = describe_scalars(points.scalars);
  const PartitionedScan scan{
      .unit = unit,
      .points = points,
      .mesh = mesh,
      .sides = sides,
      .scanned = clean.scanned.empty() ? points.positions : clean.scanned,
      .measured = coarse || least > 0 ? points.size() : result.report.points,
      .graph = graph,
      .samples = samples,
      .regions = regions,
      .scalars = scalars,
      .creases = meeting.creases ? &*meeting.creases : nullptr,
      .border = meeting.border.get(),
      .spheres = mesh.triangles.empty() ? nullptr : &in_time.spheres(),
      .follows_density = follows_density,
      .textured = textured,
      .is_borderless = in_time.is_borderless() || meeting.is_closed,
      .normals = source_of_normals(!normals.estimated, !clean.normals.empty())};
  RELIEF_TRY_ASSIGN(MeasuredModel made, make_best_model(scan, options, progress));
  result.report.fits = made.fits.fits;
  result.report.fits_replaced = made.fits.replaced;
  result.report.fit_condition = made.fits.condition;
  result.model = std::move(made.model);
  PatchModel& model = result.model;
  model.bounds = extent.bounds;
  model.bounding_radius = extent.bounding_radius;
  model.extremes = std::move(extent.extremes);
  model.is_closed = in_time.is_closed();
  model.is_of_points = meeting.creases && mesh.triangles.empty();
  model.stance = stance_of(options.up, stance_of(mesh));
  model.has_colours = textured || !points.colours.empty();
  report_model(made.fidelity, model, result.report);
  if (options.distances) {
    std::vector<glm::dvec3> measured = scan.scanned;
    measured.resize(scan.measured);
    RELIEF_TRY(add_distances(measured, model, progress));
  }
  to_world_frame(frame, model.patches);
  return result;
}

Result<ConvertResult> convert_in_arena(Points& points, const ConvertOptions& options,
                                       Progress& progress) {
  sort_in_space(points);
  const double unit = working_unit_of(points);
  to_working_unit(points, unit);
  RELIEF_TRY_ASSIGN(ConvertResult result,
                    convert_in_unit(points, to_working_unit(options, unit), unit, progress));
  to_world_unit(result, unit);
  return result;
}

}  // namespace

Result<ConvertResult> convert(Points points, const ConvertOptions& options, Progress& progress) {
  // A mesh may have few points: others are spread over its triangles.
  if (!has_triangle_colours(points)) {
    const Status enough = check_points(points.positions);
    if (!enough && !is_coarse_mesh(points)) return enough.error();
  }
  RELIEF_TRY(check_spacing(options.spacing, bounds_of(points.positions)));
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
