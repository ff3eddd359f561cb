#include "preprocess/texture/acquisition/acquire_texture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/guard.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/normals/normals.h"
#include "preprocess/texture/acquisition/continuous_texture.h"
#include "preprocess/texture/acquisition/even_sample.h"
#include "preprocess/texture/acquisition/fit_texture.h"
#include "preprocess/texture/acquisition/splat_basis.h"
#include "preprocess/texture/acquisition/surface_points.h"

namespace relief {
namespace {

// Candidates for each kept point. Yuksel uses 5; 4 give about as even sets with less time and
// memory.
constexpr std::size_t kCandidatesPerPoint = 4;
// Positions at which inner products are summed, for each splat. The equations then outnumber the
// unknowns 16 to 1, and the positions lie a quarter of h apart.
constexpr std::size_t kPositionsPerPoint = 16;
// Enough to distinguish a plane from noise if a mesh has no oriented faces.
constexpr std::uint32_t kNeighbours = 16;

bool is_finite(glm::vec2 v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

bool is_finite(const CornerTexcoords& corners) {
  return std::all_of(corners.begin(), corners.end(), [](glm::vec2 v) { return is_finite(v); });
}

template <class T>
bool all_finite(const std::vector<T>& texcoords) {
  return std::all_of(texcoords.begin(), texcoords.end(), [](const T& v) { return is_finite(v); });
}

Status check(const Points& mesh, const AcquireOptions& options) {
  const std::size_t limit = max_textured_points(options.deviation, options.cutoff);
  if (options.points < 1 || options.points > limit) {
    return make_error("{} points cannot be spread; with a cutoff of {} ask for 1 to {}",
                      options.points, options.cutoff, limit);
  }
  if (mesh.triangles.empty()) {
    return make_error("there are no triangles for the texture; use a mesh");
  }
  if (mesh.texcoords.empty()) {
    return make_error("there are no texture coordinates; use a mesh that has them");
  }
  if (!all_finite(mesh.texcoords) || !all_finite(mesh.corner_texcoords)) {
    return make_error("some texture coordinates are NaN or infinite; repair the mesh");
  }
  const double area = area_of(mesh).world;
  if (!(area > 0.0) || !std::isfinite(area)) {
    return make_error("the triangles have no area that points could be spread over");
  }
  return {};
}

void complete_normals(Points& mesh) {
  const NeighbourGraph graph = find_neighbours(mesh.positions, kNeighbours);
  complete_normals(mesh, graph, fit_local_frames(mesh.positions, graph));
}

std::vector<glm::vec3> evaluate(const ContinuousTexture& texture, const SurfacePoints& positions,
                                double deviation) {
  std::vector<glm::vec3> values(positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    values[i] = texture.at(positions.texcoords[i], deviation);
  });
  return values;
}

Result<AcquireResult> acquire(Points& mesh, const Image& texture, const AcquireOptions& options,
                              Progress& progress) {
  RELIEF_TRY(check(mesh, options));
  RELIEF_TRY_ASSIGN(const auto image, ContinuousTexture::from_image(texture));

  progress.begin_stage("spread points", 0);
  complete_normals(mesh);
  const SurfaceArea area = area_of(mesh);
  const SurfacePoints splats =
      thin_out(spread_over_triangles(mesh, kCandidatesPerPoint * options.points), options.points,
               area.world);
  if (progress.cancelled()) return interrupted_error();

  progress.begin_stage("sample texture", 0);
  AcquireResult result;
  const double texels = area.texture * image.width() * image.height();
  result.report.area = area.world;
  result.report.texels_per_point = texels / static_cast<double>(options.points);
  result.splats.deviation =
      options.deviation * std::sqrt(area.world / static_cast<double>(options.points));
  result.splats.colours = evaluate(image, splats, 1.0);
  // A Gaussian of half the distance between positions removes all detail that they would alias; it
  // adds 1/64 to the variance of a splat's own.
  const SurfacePoints positions = spread_over_triangles(mesh, kPositionsPerPoint * options.points);
  const double texels_apart = std::sqrt(texels / static_cast<double>(positions.size()));
  const std::vector<glm::vec3> truth = evaluate(
      image, positions, std::clamp(texels_apart / 2.0, 1.0, ContinuousTexture::kLargestDeviation));
  if (progress.cancelled()) return interrupted_error();

  progress.begin_stage("fit texture", 0);
  const BasisAtPositions basis =
      evaluate_basis(splats, {result.splats.deviation, options.cutoff, options.basis}, positions);
  if (options.acquisition != Acquisition::Given) {
    result.splats.colours = project_texture(basis, truth, result.splats.colours);
  }
  if (options.acquisition == Acquisition::Optimised) {
    result.splats.colours =
        fit_texture(basis, truth, result.splats.colours, progress, result.report.fit.emplace());
  }
  result.report.rms_error = rms_error(basis, result.splats.colours, truth);
  if (progress.cancelled()) return interrupted_error();
  result.splats.positions = splats.positions;
  result.splats.normals = splats.normals;
  return result;
}

}  // namespace

std::size_t max_textured_points(double deviation, double cutoff) {
  constexpr double kMaxEntries = 1e8;
  const double splats_at_a_position = 2.0 * std::numbers::pi * cutoff * deviation * deviation;
  return static_cast<std::size_t>(
      std::max(1.0, kMaxEntries / (kPositionsPerPoint * splats_at_a_position)));
}

Result<AcquireResult> acquire_texture(Points mesh, const Image& texture,
                                      const AcquireOptions& options, Progress& progress) {
  const std::string task = fmt::format("acquire a texture for {} points", options.points);
  return guarded({.subject = "",
                  .task = task,
                  .advice = kReportDefect,
                  .memory_advice = "use fewer points or a smaller texture"},
                 [&] { return acquire(mesh, texture, options, progress); });
}

}  // namespace relief
