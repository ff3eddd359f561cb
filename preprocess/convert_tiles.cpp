#include "preprocess/convert_tiles.h"

#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "common/version.h"
#include "preprocess/stream/spread_points.h"
#include "preprocess/stream/tile_conversion.h"
#include "preprocess/stream/tile_job.h"
#include "preprocess/thread_limit.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// What is converted, and how: all that the result depends on.
Result<std::string> fingerprint_of(const std::vector<fs::path>& files,
                                   const ConvertOptions& options,
                                   const PatchFileOptions& file_options,
                                   const SpreadOptions& spread_options) {
  std::string text = fmt::format(
      "relief {} tiles 1\nspacing {} cone {} overlap {} step {} colours {}\ncodec {} normals {}\n"
      "tile {}\n",
      kVersion, options.spacing, options.cone_degrees, options.overlap_cells, options.height_step,
      options.colour_scale, static_cast<int>(file_options.codec), file_options.normal_degrees,
      tile_points(spread_options));
  for (const fs::path& file : files) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    const auto time = error ? fs::file_time_type{} : fs::last_write_time(file, error);
    if (error) return make_error("{}: cannot be opened: {}", file.string(), error.message());
    text += fmt::format("{} {} {}\n", fs::absolute(file).string(), size,
                        time.time_since_epoch().count());
  }
  return text;
}

}  // namespace

Result<std::optional<TiledResult>> convert_tiles(
    const std::vector<fs::path>& files, const fs::path& output, const ConvertOptions& options,
    const PatchFileOptions& file_options, const TileOptions& tile_options, Progress& progress) {
  const SpreadOptions spread_options{tile_options.memory_bytes, tile_options.most_tile_points,
                                     options.spacing};
  const auto fingerprint = fingerprint_of(files, options, file_options, spread_options);
  if (!fingerprint) return fingerprint.error();
  auto job = TileJob::open(output, *fingerprint);
  if (!job) return job.error();
  auto scan = spread_points(files, *job, spread_options, progress);
  if (!scan || !*scan) job->remove();  // what there is, is not worth to go on from
  if (!scan) return scan.error();
  if (!*scan) return std::optional<TiledResult>();
  auto result = with_threads(options.threads, [&] {
    return convert_spread({files.front().string(), *job, std::move(**scan), options, file_options},
                          output, progress);
  });
  if (!result) return result.error();
  job->remove();
  return std::optional(std::move(*result));
}

std::optional<fs::path> find_kept_tiles(const fs::path& output) {
  fs::path folder = TileJob::folder_of(output);
  return fs::exists(folder) ? std::optional(std::move(folder)) : std::nullopt;
}

}  // namespace relief
