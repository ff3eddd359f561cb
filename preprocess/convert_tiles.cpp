#include "preprocess/convert_tiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>
#include <utility>

#include "common/extremes.h"
#include "common/guard.h"
#include "common/io/file.h"
#include "common/io/standard_input.h"
#include "common/version.h"
#include "preprocess/thread_limit.h"
#include "preprocess/tiles/overviews.h"
#include "preprocess/tiles/spread_points.h"
#include "preprocess/tiles/tile_conversion.h"
#include "preprocess/tiles/tile_job.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Every digit of the crop; empty without one.
std::string crop_text(const PointSelection& selection) {
  if (!selection.crop) return {};
  const auto& [low, high] = *selection.crop;
  return fmt::format("crop {} {} {} {} {} {}", low.x, low.y, low.z, high.x, high.y, high.z);
}

/// "all", names with commas between, or nothing.
std::string scalars_text(const ScalarChoice& choice) {
  return choice.all ? "all" : fmt::format("{}", fmt::join(choice.names, ","));
}

/// Input and options: everything on which the tiles depend.
Result<std::string> fingerprint_of(const std::vector<fs::path>& files,
                                   const ConvertOptions& options,
                                   const PatchFileOptions& file_options,
                                   const SpreadOptions& spread_options) {
  std::string text = fmt::format(
      "relief {} tiles 11\nnoise {} {}\nspacing {} cone {} overlap {} step {} colours {} side {} "
      "{} {} {}\n"
      "codec {} normals {}\ntile {}\nread {} {} {} scalars {}\n",
      kVersion, static_cast<int>(options.noise_removal), options.noise, options.spacing,
      options.cone_degrees, options.seams.value_or(false) ? -1 : options.overlap_cells,
      options.height_step, options.colour_scale, static_cast<int>(options.side.side),
      options.side.toward.x, options.side.toward.y, options.side.toward.z,
      static_cast<int>(file_options.codec), file_options.normal_degrees,
      tile_points(spread_options, spread_options.read.scalars.empty() ? 0 : kMaxScalars),
      spread_options.read.format, describe_classes(spread_options.read.selection),
      crop_text(spread_options.read.selection), scalars_text(spread_options.read.scalars));
  for (const fs::path& file : files) {
    std::error_code error;
    const auto size = fs::file_size(input_path(file), error);
    const auto time = error ? fs::file_time_type{} : fs::last_write_time(input_path(file), error);
    if (error) return make_error("{}: cannot be opened: {}", file.string(), error.message());
    text += fmt::format("{} {} {}\n", fs::absolute(file).string(), size,
                        time.time_since_epoch().count());
  }
  return text;
}

/// Returns only the tiles' own patches.
std::vector<TreePart> own_parts(const TileJob& job, std::size_t tiles) {
  std::vector<TreePart> parts;
  for (std::size_t tile = 0; tile < tiles; ++tile) parts.push_back({job.part(tile)});
  return parts;
}

/// Returns the extreme points of the coarsest patches: of what is drawn, as stray points are in the
/// bounds here.
Result<std::vector<glm::dvec3>> drawn_extremes(const std::vector<TreePart>& parts,
                                               const Bounds& bounds, Progress& progress) {
  std::vector<glm::dvec3> extremes;
  for (const TreePart& part : parts) {
    if (part.parent != kNoTile) continue;
    RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(part.path));
    QuietProgress quiet(progress);
    RELIEF_TRY_ASSIGN(const auto model, file.read_all(quiet));
    std::vector<glm::dvec3> positions;
    for_each_position(model.patches, [&](const glm::dvec3& p) { positions.push_back(p); });
    const auto found = extreme_points(positions, bounds);
    extremes.insert(extremes.end(), found.begin(), found.end());
  }
  return extreme_points(extremes, bounds);
}

/// Makes the patch file from tiles of points.
Result<TiledResult> convert_all(const TiledModel& plan, bool overviews, const fs::path& output,
                                Progress& progress) {
  auto converted = convert_spread({.name = plan.name,
                                   .folder = plan.job,
                                   .scan = plan.scan,
                                   .options = plan.options,
                                   .file_options = plan.file_options},
                                  progress);
  if (!converted) return converted.error();
  if (converted->patches == 0)
    return make_error("{}: the points are too scattered to be a surface", plan.name);
  TiledModel model = plan;
  model.spacing = converted->extent.spacing;
  RELIEF_TRY_ASSIGN(auto parts, overviews ? make_overviews(model, progress)
                                          : Result(own_parts(plan.job, plan.scan.counts.size())));

  progress.begin_stage("write", 0);
  if (progress.cancelled()) return interrupted_error();
  PatchModel& extent = converted->extent;
  RELIEF_TRY_ASSIGN(extent.extremes, drawn_extremes(parts, extent.bounds, progress));
  const Status written = write_patch_tree(plan.job.whole(), parts, extent);
  if (!written) {
    return make_error("{}; if this happens again, remove {} and convert again",
                      written.error().message, plan.job.folder().string());
  }
  const Status moved = move_into_place(plan.job.whole(), output);
  return moved ? Result(std::move(converted->result)) : moved.error();
}

Result<std::optional<TiledResult>> convert_files(
    const std::vector<fs::path>& files, const fs::path& output, const ConvertOptions& options,
    const PatchFileOptions& file_options, const TileOptions& tile_options, Progress& progress) {
  const SpreadOptions spread_options{tile_options.memory_bytes, tile_options.max_tile_points,
                                     options.spacing, tile_options.read};
  RELIEF_TRY_ASSIGN(const auto fingerprint,
                    fingerprint_of(files, options, file_options, spread_options));
  RELIEF_TRY_ASSIGN(auto job, TileJob::open(output, fingerprint));
  auto scan = spread_points(files, job, spread_options, progress);
  if (!scan || !*scan) job.remove();  // its results are not worth continuing
  if (!scan) return scan.error();
  if (!*scan) return std::optional<TiledResult>();
  const TiledModel plan{
      .name = files.front().string(),
      .job = job,
      .scan = **scan,
      .options = options,
      .file_options = file_options,
      .tile_points = tile_points(spread_options, (*scan)->attributes.scalars.size()),
      .overview_samples = tile_options.overview_samples};
  auto result = with_threads(
      options.threads, [&] { return convert_all(plan, tile_options.overviews, output, progress); });
  if (!result) return result.error();
  job.remove();
  return std::optional(std::move(*result));
}

}  // namespace

Result<std::optional<TiledResult>> convert_tiles(
    const std::vector<fs::path>& files, const fs::path& output, const ConvertOptions& options,
    const PatchFileOptions& file_options, const TileOptions& tile_options, Progress& progress) {
  const std::string name = output.string();
  if (options.distances) {
    return make_error(
        "{}: distances to the points are not kept in tiles: their range is known at the end only; "
        "leave out --memory, or the scalar {}",
        name, kDistanceScalar);
  }
  return guarded(
      {.subject = name,
       .task = "convert its tiles",
       .advice = kReportDefect,
       .memory_advice = "set a lower --memory or a larger --spacing"},
      [&] { return convert_files(files, output, options, file_options, tile_options, progress); });
}

std::optional<fs::path> find_kept_tiles(const fs::path& output) {
  fs::path folder = TileJob::folder_of(output);
  std::error_code ignored;
  return fs::exists(folder, ignored) ? std::optional(std::move(folder)) : std::nullopt;
}

}  // namespace relief
