#include "preprocess/tiles/resample_tile.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <tuple>
#include <utility>

#include "common/seams/make_seams.h"
#include "preprocess/convert_stages.h"
#include "preprocess/measure/measure.h"
#include "preprocess/resample/region_patches.h"
#include "preprocess/tiles/checkpoint.h"

namespace relief {
namespace {

/// Contents of a report: everything but the patches.
template <class Tile>
auto tile_fields(Tile& t) {
  return std::tie(t.patch_count, t.points, t.sum_of_squares, t.error_max, t.uncovered, t.texels);
}

/// The survey's regions, and its normals on the sides that `turns` gives them. A region's points
/// are already consistent in the survey: it flips if most of them do.
std::vector<Region> turn_regions(TileSurvey& survey, const std::vector<std::uint8_t>& turns) {
  std::vector<Region> regions(survey.region_normals.size());
  for (std::uint32_t i = 0; i < survey.region.size(); ++i) {
    if (survey.region[i] != kNoRegion) regions[survey.region[i]].points.push_back(i);
  }
  for (std::size_t r = 0; r < regions.size(); ++r) regions[r].normal = survey.region_normals[r];
  if (survey.sheets.count == 0) return regions;

  std::vector<std::uint8_t> is_turned(survey.normals.size());
  for (std::size_t i = 0; i < is_turned.size(); ++i)
    is_turned[i] = turns[survey.sheets.of_point[i]];
  for (Region& region : regions) {
    std::size_t turned = 0;
    for (const std::uint32_t i : region.points) turned += is_turned[i];
    const bool turn_all = 2 * turned > region.points.size();
    for (const std::uint32_t i : region.points) is_turned[i] = turn_all ? 1 : 0;
    if (turn_all) region.normal = -region.normal;
  }
  for (std::size_t i = 0; i < is_turned.size(); ++i) {
    if (is_turned[i] != 0) survey.normals[i] = -survey.normals[i];
  }
  return regions;
}

}  // namespace

TilePatches resample_tile(SurveyedTile surveyed, const ResampleOptions& options,
                          Progress& progress) {
  const TilePoints& tile = surveyed.points;
  TileSurvey& survey = surveyed.survey;
  TilePatches made;
  made.points = tile.own;
  if (survey.region_normals.empty()) {
    // Without a surface, all points have the distance that measure_fidelity assumes for uncovered
    // points.
    made.uncovered = tile.own;
    made.error_max = tile.own > 0 ? kUncoveredInSpacings * options.spacing : 0.0;
    made.sum_of_squares = static_cast<double>(tile.own) * made.error_max * made.error_max;
    return made;
  }
  std::vector<Region> regions = turn_regions(survey, surveyed.turns);
  const NeighbourGraph graph = find_neighbours(tile.points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return made;
  const SurfaceSamples samples{tile.points.positions, survey.normals, graph.spacing,
                               survey.roughness};
  // The slope of the halo's points in their own patches decides about margins at the border.
  Membership membership = membership_of(samples, regions);
  membership.of_others = static_cast<std::uint32_t>(tile.own);
  assert(surveyed.halo_cosines.size() == tile.home.size());
  std::ranges::copy(surveyed.halo_cosines,
                    membership.cosine.begin() + static_cast<std::ptrdiff_t>(tile.own));
  std::optional<CreaseNormals> creases;
  if (options.seams) creases = find_creases(tile.points.positions, survey.normals, graph);
  made.patches = make_patches({.samples = samples,
                               .graph = graph,
                               .membership = membership,
                               .colours = tile.points.colours,
                               .creases = creases ? &*creases : nullptr,
                               .scalars = tile.points.scalars,
                               .scalar_infos = surveyed.scalars},
                              std::vector<double>(regions.size(), 1.0), options, regions, progress);
  if (progress.cancelled()) return made;
  // Errors are those of the points as scanned, noise included.
  const std::vector<glm::dvec3>& measured =
      tile.scanned.empty() ? tile.points.positions : tile.scanned;
  std::vector<double> distances = distances_to_patches(
      measured, tile.own, graph, owners_of(regions, tile.points.size()), made.patches);
  if (options.seams) {
    compare_with_seams(measured, made.patches,
                       SeamDistances(made.patches, make_seams(made.patches)), distances);
  }
  const Fidelity fidelity = measure_fidelity(measured, distances, made.patches);
  made.sum_of_squares = fidelity.rms * fidelity.rms * static_cast<double>(tile.own);
  made.error_max = fidelity.max;
  made.uncovered = fidelity.uncovered;
  made.patch_count = made.patches.size();
  count_texels(made.patches, made.texels);
  return made;
}

Status save_report(const std::filesystem::path& path, const TilePatches& tile) {
  return save_checkpoint(path, tile_fields(tile));
}

Result<TilePatches> load_report(const std::filesystem::path& path) {
  TilePatches tile;
  RELIEF_TRY(load_checkpoint(path, tile_fields(tile)));
  return tile;
}

}  // namespace relief
