#include "preprocess/tiles/overviews.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numeric>
#include <system_error>
#include <utility>

#include "common/patch_file/patch_tree_layout.h"
#include "preprocess/tiles/coarse_points.h"
#include "preprocess/tiles/tile_conversion.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// A level that leaves more than this share of the samples of the one below is not worth its bytes:
/// the rest are borders of patches.
constexpr double kMaxLeft = 0.6;
/// Margins belong to both adjacent patches: points are slightly more than a quarter of the samples,
/// and tiles cut from a scan are 0.7 full on average.
constexpr double kFullerThanCut = 1.2;

/// The tiles of a level, whose parts are in a folder.
struct Level {
  TileFolder folder;
  SpreadScan scan;
  std::vector<double> samples;  ///< of each tile
  double all_samples = 0.0;
};

Status count_samples(Level& level) {
  for (std::uint32_t tile = 0; tile < level.scan.counts.size(); ++tile) {
    RELIEF_TRY_ASSIGN(const auto tree, PatchTree::open(level.folder.part(tile)));
    level.samples.push_back(static_cast<double>(tree.tiles().front().samples));
    level.all_samples += level.samples.back();
  }
  return {};
}

/// Distributes the points of a level's patches to the tiles of the next level.
Status spread_level(const Level& below, TileWriter& tiles, SpreadScan& scan,
                    const Progress& progress) {
  for (std::uint32_t tile = 0; tile < below.scan.counts.size(); ++tile) {
    RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(below.folder.part(tile)));
    std::vector<std::uint64_t> all(file.patches().size());
    std::iota(all.begin(), all.end(), 0U);
    QuietProgress quiet(progress);
    RELIEF_TRY_ASSIGN(const auto patches, file.read_patches(all, quiet));
    std::vector<Points> points(patches.size());
    const std::vector<ScalarInfo>& scalars = scan.attributes.scalars;
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t p) { points[p] = coarse_points(patches[p], scalars); });
    for (Points& of_patch : points) {
      to_tiles(scan, of_patch);
      scan.read.points += of_patch.size();
      RELIEF_TRY(tiles.add(of_patch));
    }
  }
  return tiles.finish();
}

/// Writes the points of the level over `below` to tile files.
Result<SpreadScan> open_level(const TiledModel& model, const Level& below, double spacing,
                              const TileFolder& folder, const Progress& progress) {
  if (fs::exists(folder.layout())) return load_scan(folder.layout());
  std::error_code error;
  fs::remove_all(folder.folder(), error);
  fs::create_directory(folder.folder(), error);
  if (error) return make_error("{}: cannot be made: {}", folder.folder().string(), error.message());
  SpreadScan scan;
  scan.unit = model.scan.unit;
  scan.frame = model.scan.frame;
  std::vector<double> load;
  for (const double samples : below.samples) load.push_back(samples / 4.0);
  scan.layout =
      coarser_layout(below.scan.layout, load,
                     kFullerThanCut * static_cast<double>(model.tile_points), spacing / scan.unit);
  scan.attributes = model.scan.attributes;
  scan.attributes.normals = true;
  scan.bounds = model.scan.bounds;
  TileWriter tiles(folder.folder(), scan.layout, scan.attributes);
  RELIEF_TRY(spread_level(below, tiles, scan, progress));
  scan.counts = tiles.counts();
  RELIEF_TRY(save_scan(folder.layout(), scan));
  return scan;
}

/// Makes the level over `below`; `level` is its number.
Result<Level> make_level(const TiledModel& model, const Level& below, unsigned number,
                         Progress& progress) {
  ConvertOptions options = model.options;
  options.spacing = std::ldexp(model.spacing, static_cast<int>(number));
  options.height_step = std::ldexp(options.height_step, static_cast<int>(number));
  options.colour_scale = 1;  // they are drawn where samples are no farther apart than pixels
  const TileFolder folder = model.job.overview(number);
  RELIEF_TRY_ASSIGN(auto scan, open_level(model, below, options.spacing, folder, progress));
  const auto made =
      convert_spread({model.name, folder, scan, options, model.file_options, true}, progress);
  if (!made) return made.error();
  Level level{folder, std::move(scan), {}, 0.0};
  RELIEF_TRY(count_samples(level));
  return level;
}

/// Returns the tiles of all levels, the coarsest first, with their parents.
std::vector<TreePart> list_tiles(const std::vector<Level>& levels) {
  std::vector<TreePart> parts;
  std::uint32_t above = 0;  // where the tiles of the level above begin
  for (std::size_t l = levels.size(); l-- > 0;) {
    const Level& level = levels[l];
    const auto first = static_cast<std::uint32_t>(parts.size());
    for (std::uint32_t tile = 0; tile < level.scan.counts.size(); ++tile) {
      TreePart part{level.folder.part(tile), static_cast<std::uint32_t>(l), kNoTile};
      if (l + 1 < levels.size()) {
        const TileLayout& coarser = levels[l + 1].scan.layout;
        part.parent = above + coarser.tile_about(level.scan.layout.tiles[tile]);
      }
      parts.push_back(std::move(part));
    }
    above = first;
  }
  return parts;
}

}  // namespace

Result<std::vector<TreePart>> make_overviews(const TiledModel& model, Progress& progress) {
  std::vector<Level> levels;
  levels.push_back({model.job, model.scan, {}, 0.0});
  RELIEF_TRY(count_samples(levels.back()));
  // A third as many samples as the model has, each processed twice.
  progress.begin_stage("overviews",
                       static_cast<std::uint64_t>(levels.back().all_samples * 2.0 / 3.0));
  PartProgress inner(progress);
  while (levels.back().all_samples > static_cast<double>(model.overview_samples) &&
         levels.size() < kMaxTreeLevels) {
    RELIEF_TRY_ASSIGN(
        auto level, make_level(model, levels.back(), static_cast<unsigned>(levels.size()), inner));
    const bool is_worth_it =
        level.all_samples > 0.0 && level.all_samples <= kMaxLeft * levels.back().all_samples;
    if (!is_worth_it) break;
    levels.push_back(std::move(level));
  }
  return list_tiles(levels);
}

}  // namespace relief
