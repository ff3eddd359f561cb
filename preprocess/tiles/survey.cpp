#include "preprocess/tiles/survey.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

#include "preprocess/partition/find_regions.h"
#include "preprocess/points/no_point.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/resample/resample.h"
#include "preprocess/resample/spacing/error_spacing.h"
#include "preprocess/tiles/checkpoint.h"

namespace relief {

namespace {

/// Keeps the values of the points that were kept: the first of each.
template <class T>
void keep_first(const std::vector<std::uint32_t>& number, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (number[i] == kept) values[kept++] = values[i];
  }
  values.resize(kept);
}

}  // namespace

std::vector<std::uint32_t> merge_duplicates(TilePoints& tile) {
  std::vector<std::uint32_t> number;  // of each point before
  ReadResult cleaned = clean_points(std::move(tile.points), &number);
  tile.points = std::move(cleaned.points);
  if (cleaned.merged_duplicates == 0) return tile.number;
  // A point and its duplicates are in the same tile, so that points of the halo still follow own
  // ones.
  std::size_t own = 0;
  for (std::size_t i = 0; i < tile.own; ++i) own = std::max<std::size_t>(own, number[i] + 1);
  std::size_t kept = own;
  for (std::size_t h = 0; h < tile.home.size(); ++h) {
    if (number[tile.own + h] == kept) tile.home[kept++ - own] = tile.home[h];
  }
  tile.home.resize(kept - own);
  keep_first(number, tile.scanned);
  keep_first(number, tile.smooth_normals);
  number.resize(tile.own);
  tile.own = own;
  if (tile.number.empty()) return number;
  std::vector<std::uint32_t> in_file = tile.number;
  for (std::uint32_t& i : in_file) i = i == kNoPoint ? kNoPoint : number[i];
  return in_file;
}

namespace {

/// Contents of a survey's file: everything but the cosines.
template <class Survey>
auto survey_fields(Survey& s) {
  return std::tie(s.number, s.normals, s.roughness, s.sheets.of_point, s.sheets.count, s.sums,
                  s.region, s.region_normals, s.normals_repaired, s.area, s.radius);
}

std::vector<float> own_cosines(const TilePoints& tile, const TileSurvey& survey,
                               const std::vector<Region>& regions) {
  const std::size_t count = survey.number.empty() ? tile.own : survey.number.size();
  std::vector<float> cosines(count, 1.0F);
  for (std::size_t in_file = 0; in_file < count; ++in_file) {
    const std::size_t i = survey.number.empty() ? in_file : survey.number[in_file];
    if (i == kNoPoint) continue;
    if (survey.region[i] != kNoRegion)
      cosines[in_file] = glm::dot(tile.points.normals[i], regions[survey.region[i]].normal);
  }
  return cosines;
}

}  // namespace

TileSurvey survey_tile(TilePoints& tile, const SurveyOptions& options, Progress& progress) {
  TileSurvey survey;
  survey.number = merge_duplicates(tile);
  Points& points = tile.points;
  survey.region.assign(tile.own, kNoRegion);
  for (std::size_t i = 0; i < tile.own; ++i)
    survey.radius = std::max(survey.radius, glm::distance(points.positions[i], options.centre));
  if (points.size() < kMinSurfacePoints) {
    survey.normals.assign(points.size(), glm::vec3(0.0F, 0.0F, 1.0F));
    survey.roughness.assign(points.size(), 0.0F);
    survey.cosines = own_cosines(tile, survey, {});
    return survey;
  }

  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return survey;
  LocalFrames frames = fit_local_frames(points.positions, graph);
  take_known_normals(tile.smooth_normals, frames);
  const NormalsReport normals =
      complete_normals(points, graph, frames, {.side = options.side}, progress);
  survey.normals_repaired = normals.repaired;
  if (normals.oriented) {
    survey.sheets = find_sheets(graph, points.normals);
    survey.sums =
        sum_up(points, tile.own, points.normals, graph.spacing, survey.sheets, options.centre);
  }
  if (progress.cancelled()) return survey;

  std::optional<CreaseNormals> creases;
  if (options.seams) creases = find_creases(points.positions, points.normals, graph);
  const std::vector<Region> regions =
      find_regions(points, tile.own, graph, frames, options.cone_degrees,
                   creases ? &*creases : nullptr, progress);
  if (progress.cancelled()) return survey;
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r].points) survey.region[i] = r;
    survey.region_normals.push_back(regions[r].normal);
  }
  if (options.find_area && !regions.empty()) {
    const SurfaceSamples samples{points.positions, points.normals, graph.spacing, frames.roughness};
    const double spacing =
        choose_spacing(samples, graph, regions, std::vector<double>(regions.size(), 1.0),
                       usual_samples(tile.own, options.seams), options.seams);
    survey.area = static_cast<double>(tile.own) * spacing * spacing;
  }
  survey.cosines = own_cosines(tile, survey, regions);
  survey.normals = points.normals;
  survey.roughness = std::move(frames.roughness);
  return survey;
}

Result<std::vector<float>> halo_cosines(
    const TilePoints& tile,
    const std::function<Result<std::vector<float>>(std::uint32_t tile)>& load) {
  std::vector<float> cosines(tile.home.size());
  for (const auto& [home, points] : halo_by_home(tile)) {
    RELIEF_TRY_ASSIGN(const auto of_home, load(home));
    for (const std::size_t h : points) cosines[h] = of_home[tile.home[h].point];
  }
  return cosines;
}

std::vector<RimPoint> rim_of(const TilePoints& tile, const TileSurvey& survey) {
  std::vector<RimPoint> rim;
  rim.reserve(tile.home.size());
  for (std::size_t h = 0; h < tile.home.size(); ++h) {
    const std::size_t i = tile.own + h;
    const std::uint32_t sheet = survey.sheets.count > 0 ? survey.sheets.of_point[i] : 0;
    rim.push_back({tile.home[h], survey.normals[i], sheet});
  }
  std::sort(rim.begin(), rim.end(), [](const RimPoint& a, const RimPoint& b) {
    return std::tie(a.home.tile, a.home.point) < std::tie(b.home.tile, b.home.point);
  });
  return rim;
}

Status save_survey(const std::filesystem::path& path, const TileSurvey& survey) {
  return save_checkpoint(path, survey_fields(survey));
}

Result<TileSurvey> load_survey(const std::filesystem::path& path) {
  TileSurvey survey;
  RELIEF_TRY(load_checkpoint(path, survey_fields(survey)));
  return survey;
}

}  // namespace relief
