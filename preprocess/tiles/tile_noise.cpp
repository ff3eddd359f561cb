#include "preprocess/tiles/tile_noise.h"

#include <map>
#include <tuple>
#include <utility>

#include "common/neighbours/neighbours.h"
#include "preprocess/noise/remove_noise.h"
#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/survey.h"

namespace relief {
namespace {

template <class Noise>
auto noise_fields(Noise& n) {
  return std::tie(n.positions, n.normals, n.noise, n.moved);
}

}  // namespace

TileNoise find_tile_noise(TilePoints tile, std::optional<double> given, Progress& progress) {
  TileNoise found;
  const std::size_t in_file = tile.own;
  // Points in one place move together: they are still merged afterwards.
  const std::vector<std::uint32_t> number = merge_duplicates(tile);
  if (tile.points.size() < kMinSurfacePoints) return found;
  const NeighbourGraph graph = find_neighbours(tile.points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return found;
  const NoiselessPoints noiseless =
      remove_noise(tile.points.positions, graph.spacing, given, progress);
  found.noise = noiseless.report.noise;
  if (noiseless.report.moved == 0 || progress.cancelled()) return found;
  for (std::size_t i = 0; i < in_file; ++i) {
    const std::size_t point = number.empty() ? i : number[i];
    found.positions.push_back(noiseless.smooth.positions[point]);
    found.normals.push_back(noiseless.smooth.normals[point]);
    found.moved += found.normals.back() != glm::vec3(0.0F) ? 1 : 0;
  }
  return found;
}

Status move_tile_points(TilePoints& tile, std::uint32_t own,
                        const std::function<Result<TileNoise>(std::uint32_t tile)>& load) {
  std::map<std::uint32_t, std::vector<std::size_t>> by_home;
  for (std::size_t h = 0; h < tile.home.size(); ++h) by_home[tile.home[h].tile].push_back(h);
  by_home.try_emplace(own);
  std::vector<glm::dvec3> positions = tile.points.positions;
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F));
  bool any = false;
  for (const auto& [home, points] : by_home) {
    RELIEF_TRY_ASSIGN(const TileNoise noise, load(home));
    if (noise.positions.empty()) continue;
    any = true;
    const auto move = [&](std::size_t point, std::size_t in_file) {
      positions[point] = noise.positions[in_file];
      normals[point] = noise.normals[in_file];
    };
    for (const std::size_t h : points) move(tile.own + h, tile.home[h].point);
    for (std::size_t i = 0; home == own && i < tile.own; ++i) move(i, i);
  }
  if (!any) return {};
  tile.scanned = std::exchange(tile.points.positions, std::move(positions));
  tile.smooth_normals = std::move(normals);
  return {};
}

Status save_noise(const std::filesystem::path& path, const TileNoise& noise) {
  return save_checkpoint(path, noise_fields(noise));
}

Result<TileNoise> load_noise(const std::filesystem::path& path) {
  TileNoise noise;
  RELIEF_TRY(load_checkpoint(path, noise_fields(noise)));
  return noise;
}

}  // namespace relief
