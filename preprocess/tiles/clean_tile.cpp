#include "preprocess/tiles/clean_tile.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "common/neighbours/neighbours.h"
#include "preprocess/noise/remove_noise.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/points/stray_points.h"
#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/survey.h"

namespace relief {
namespace {

template <class Clean>
auto clean_fields(Clean& c) {
  return std::tie(c.stray, c.positions, c.normals, c.noise, c.moved, c.strays);
}

/// Drops points of a tile, and notes what became of its own.
void drop_tile_points(const std::vector<std::uint8_t>& dropped, TilePoints& tile) {
  tile.number = indices_after(dropped);
  tile.number.resize(tile.own);
  drop_values(std::span(dropped).subspan(tile.own), tile.home);
  drop_values(dropped, tile.scanned);
  drop_values(dropped, tile.smooth_normals);
  drop_points(tile.points, dropped);
  tile.own = tile.points.size() - tile.home.size();
}

}  // namespace

CleanTile clean_tile(TilePoints tile, const ConvertOptions& options, Progress& progress) {
  CleanTile clean;
  const std::size_t in_file = tile.own;
  // Points in one place stay together: they are merged again afterwards.
  const std::vector<std::uint32_t> number = merge_duplicates(tile);
  Points& points = tile.points;
  if (points.size() < kMinSurfacePoints) return clean;
  NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return clean;
  const std::vector<std::uint8_t> stray = drop_stray_points(points, graph, progress);
  const std::vector<std::uint32_t> left = indices_after(stray);
  NoiselessPoints noiseless;
  if (options.noise_removal != NoiseRemoval::None) {
    noiseless = remove_noise(points.positions, graph.spacing, given_noise(options), progress);
  }
  if (progress.cancelled()) return clean;
  clean.noise = noiseless.report.noise;
  clean.strays = static_cast<std::uint64_t>(
      std::count(stray.begin(), stray.begin() + static_cast<std::ptrdiff_t>(tile.own), 1));
  const bool any_moved = noiseless.report.moved > 0;
  for (std::size_t i = 0; i < in_file; ++i) {
    const std::size_t merged = number.empty() ? i : number[i];
    const bool is_stray = stray[merged] != 0;
    clean.stray.push_back(stray[merged]);
    if (!any_moved) continue;
    clean.positions.push_back(is_stray ? glm::dvec3(0.0)
                                       : noiseless.smooth.positions[left[merged]]);
    clean.normals.push_back(is_stray ? glm::vec3(0.0F) : noiseless.smooth.normals[left[merged]]);
    clean.moved += clean.normals.back() != glm::vec3(0.0F) ? 1 : 0;
  }
  if (clean.strays == 0) clean.stray.clear();
  return clean;
}

Status take_clean_points(TilePoints& tile, std::uint32_t own,
                         const std::function<Result<CleanTile>(std::uint32_t tile)>& load) {
  auto by_home = halo_by_home(tile);
  by_home.try_emplace(own);
  std::vector<glm::dvec3> positions = tile.points.positions;
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F));
  std::vector<std::uint8_t> stray(positions.size(), 0);
  bool any_moved = false;
  bool any_stray = false;
  for (const auto& [home, points] : by_home) {
    RELIEF_TRY_ASSIGN(const CleanTile clean, load(home));
    any_moved = any_moved || !clean.positions.empty();
    any_stray = any_stray || !clean.stray.empty();
    const auto take = [&](std::size_t point, std::size_t in_file) {
      if (!clean.stray.empty()) stray[point] = clean.stray[in_file];
      if (clean.positions.empty()) return;
      positions[point] = clean.positions[in_file];
      normals[point] = clean.normals[in_file];
    };
    for (const std::size_t h : points) take(tile.own + h, tile.home[h].point);
    for (std::size_t i = 0; home == own && i < tile.own; ++i) take(i, i);
  }
  if (any_moved) {
    tile.scanned = std::exchange(tile.points.positions, std::move(positions));
    tile.smooth_normals = std::move(normals);
  }
  if (any_stray) drop_tile_points(stray, tile);
  return {};
}

Status save_clean_tile(const std::filesystem::path& path, const CleanTile& clean) {
  return save_checkpoint(path, clean_fields(clean));
}

Result<CleanTile> load_clean_tile(const std::filesystem::path& path) {
  CleanTile clean;
  RELIEF_TRY(load_checkpoint(path, clean_fields(clean)));
  return clean;
}

}  // namespace relief
