#include "preprocess/clean_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "preprocess/noise/remove_noise.h"
#include "preprocess/points/sort_in_space.h"
#include "preprocess/points/stray_points.h"

namespace relief {
namespace {

NoiseRemoval removal_of(const ConvertOptions& options, bool is_bare) {
  if (options.noise_removal != NoiseRemoval::Default) return options.noise_removal;
  return is_bare ? NoiseRemoval::AsMeasured : NoiseRemoval::None;
}

}  // namespace

Result<CleanScan> drop_strays(Points& points, const ConvertOptions& options, ConvertReport& report,
                              Progress& progress) {
  CleanScan clean;
  const bool is_bare = points.triangles.empty();
  if (points.size() < kMinSurfacePoints ||
      (!is_bare && removal_of(options, is_bare) == NoiseRemoval::None))
    return clean;
  progress.begin_stage("neighbours", 0);
  clean.graph = find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return interrupted_error();
  if (is_bare) {
    report.stray_points = static_cast<std::uint64_t>(
        std::ranges::count(drop_stray_points(points, *clean.graph, progress), 1));
  }
  // Points far away give the scan another frame, and all others one place in it.
  if (report.stray_points > 0) clean.graph = reordered(*clean.graph, sort_in_space(points));
  if (progress.cancelled()) return interrupted_error();
  return clean;
}

Status drop_noise(Points& points, const ConvertOptions& options, double unit, CleanScan& clean,
                  ConvertReport& report, Progress& progress) {
  const bool is_bare = points.triangles.empty();
  const NoiseRemoval removal = removal_of(options, is_bare);
  if (!clean.graph || removal == NoiseRemoval::None) return {};
  const std::optional<double> given = given_noise(options);
  NoiselessPoints noiseless = remove_noise(points.positions, clean.graph->spacing, given, progress);
  if (progress.cancelled()) return interrupted_error();
  report.noise = noiseless.report.noise;
  report.points_moved = noiseless.report.moved;
  if (given && report.points_moved == 0) {
    progress.note(fmt::format(
        "no noise is removed: {:.3g} is less than a twentieth of the spacing, or more than the "
        "scan is wide",
        *given * unit));
  }
  if (report.points_moved > 0) {
    clean.scanned = std::exchange(points.positions, std::move(noiseless.smooth.positions));
    clean.normals = std::move(noiseless.smooth.normals);
    if (is_bare) {
      progress.begin_stage("neighbours", 0);
      clean.graph = find_neighbours(points.positions, kSurfaceNeighbours);
    }
  }
  // Points that are added to triangles have neighbours, too.
  if (!is_bare) clean.graph.reset();
  return {};
}

}  // namespace relief
