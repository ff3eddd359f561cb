// relief convert: a scan becomes a patch file.
#include "preprocess/convert.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/convert_options.h"
#include "cli/options/output_file.h"
#include "cli/options/paths.h"
#include "cli/options/quality.h"
#include "cli/options/texture_options.h"
#include "cli/reports/convert_report.h"
#include "common/patch_file/patch_file.h"
#include "loader/load_files.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/points/outliers.h"
#include "preprocess/points/thin.h"
#include "preprocess/raster/convert_raster.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/read_points.h"

namespace relief::cli {
namespace {

constexpr const char* kConvertExamples =
    "Several files are parts of one scan, in one\n"
    "frame. A .conf file (bun.conf) names range scans beside it and the pose of each.\n"
    "\n"
    "Examples:\n"
    "  relief convert dragon.ply.gz -o dragon.relief\n"
    "  relief convert scan1.pcd scan2.pcd -o room.relief --spacing 0.01\n"
    "  relief convert range/bun.conf -o bunny.relief --clean\n"
    "  relief convert dragon.ply.gz -o dragon.relief --json > dragon.json";

/// Adds the contents of the written file.
Result<ConvertSummary> summarise(const ConvertArguments& arguments, ConvertSummary summary) {
  RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(arguments.output));
  summary.file = file.info();
  return summary;
}

/// Converts in tiles. Returns nothing if the scan fits into the memory limit.
Result<std::optional<ConvertSummary>> convert_larger(const ConvertArguments& arguments,
                                                     Progress& progress) {
  RELIEF_TRY_ASSIGN(auto tiled, convert_tiles(arguments.inputs, arguments.output, arguments.options,
                                              arguments.file, arguments.tiles, progress));
  if (!tiled) return std::optional<ConvertSummary>();
  InterruptedFiles::note_complete();
  ConvertSummary summary;
  for (const std::string& text : tiled->notes) progress.note(text);
  summary.report = tiled->report;
  summary.read.dropped_nonfinite = tiled->nonfinite;
  summary.read.left_out = tiled->left_out;
  summary.read.not_selected = tiled->not_selected;
  summary.read.merged_duplicates = tiled->duplicates;
  summary.tiled = std::move(*tiled);
  RELIEF_TRY_ASSIGN(auto done, summarise(arguments, std::move(summary)));
  return std::optional(std::move(done));
}

/// Writes the patches.
Status write_patches(const ConvertArguments& arguments, const PatchModel& model,
                     Progress& progress) {
  // The last moment at which nothing is there yet; writing takes well under a second.
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("write", 0);
  RELIEF_TRY(write_patch_file(arguments.output, model, arguments.file));
  InterruptedFiles::note_complete();
  return {};
}

/// Converts the only input, a raster.
Result<ConvertSummary> convert_heights(const ConvertArguments& arguments, Progress& progress) {
  const std::filesystem::path& input = arguments.inputs.front();
  if (arguments.tiles.memory_bytes > 0 || arguments.clean || arguments.thin > 0.0) {
    return make_error(
        "{}: is a raster, whose cells become samples as they are; leave out --memory, --clean and "
        "--thin; --crop converts a part of it",
        input.string());
  }
  RELIEF_TRY_ASSIGN(const auto converted,
                    convert_raster(input, texture_choice(arguments.texture, false),
                                   arguments.options, arguments.tiles.read, progress));
  RELIEF_TRY(write_patches(arguments, converted.model, progress));
  ConvertSummary summary;
  summary.report = converted.report;
  return summarise(arguments, std::move(summary));
}

/// Reads, converts and writes.
Result<ConvertSummary> convert_files(const ConvertArguments& arguments, Progress& progress) {
  if (arguments.inputs.size() == 1 &&
      is_raster(arguments.inputs.front(), arguments.tiles.read.format))
    return convert_heights(arguments, progress);
  if (arguments.tiles.memory_bytes > 0) {
    RELIEF_TRY_ASSIGN(auto larger, convert_larger(arguments, progress));
    if (larger) return std::move(*larger);
  }
  RELIEF_TRY_ASSIGN(
      auto read, load_points(arguments.inputs, texture_choice(arguments.texture, arguments.flips_v),
                             progress, arguments.tiles.read));
  ConvertSummary summary;
  if (arguments.clean) summary.outliers = remove_outliers(read.points, progress);
  if (summary.outliers.were_too_many)
    progress.note("more than half of the points look like outliers; --clean removed none");
  if (progress.cancelled()) return interrupted_error();
  if (arguments.thin > 0.0) summary.thinned = thin_points(read.points, arguments.thin);
  auto converted = convert(std::move(read.points), arguments.options, progress);
  if (!converted) {
    return make_error("{}: {}", arguments.inputs.front().string(), converted.error().message);
  }
  RELIEF_TRY(write_patches(arguments, converted->model, progress));
  summary.read = std::move(read);
  summary.report = converted->report;
  return summarise(arguments, std::move(summary));
}

std::vector<std::filesystem::path> files_read(const ConvertArguments& arguments) {
  std::vector<std::filesystem::path> files = arguments.inputs;
  if (!arguments.texture.empty()) files.push_back(arguments.texture);
  return files;
}

/// Describes the tiles that an interrupted conversion keeps; empty if there are none.
std::string kept_by(const ConvertArguments& arguments) {
  const auto kept = find_kept_tiles(arguments.output);
  if (arguments.tiles.memory_bytes == 0 || !kept) return {};
  return fmt::format("finished tiles are kept in {}; run the same command again to resume",
                     kept->string());
}

int run_convert(ConvertArguments arguments) {
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path named = arguments.output;
  auto output = OutputFile::open(named, ".relief");
  if (!output) return fail(output.error());
  arguments.output = output->path();
  if (const Status opened = open_inputs(arguments.inputs); !opened) return fail(opened.error());
  if (const Status writable = check_output(arguments.output, files_read(arguments)); !writable) {
    return fail(writable.error());
  }
  const InterruptedFiles unfinished({arguments.output}, [&] { return kept_by(arguments); });
  const tbb::global_control threads(
      tbb::global_control::max_allowed_parallelism,
      arguments.options.threads > 0 ? static_cast<std::size_t>(arguments.options.threads)
                                    : static_cast<std::size_t>(tbb::info::default_concurrency()));
  ConsoleProgress progress;
  auto summary = convert_files(arguments, progress);
  const auto& stages = progress.finish();
  if (!summary) return fail(summary.error(), kept_by(arguments));
  summary->stages = stages;
  summary->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return arguments.json ? output->finish_json(convert_json(*summary))
                        : output->finish(convert_text(*summary, named));
}

}  // namespace

void add_convert(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("convert", "Convert a scan or mesh to a patch file");
  const auto arguments = std::make_shared<ConvertArguments>();
  add_convert_options(*sub, *arguments);
  const auto quality = std::make_shared<std::optional<Quality>>();
  add_quality_option(*sub, *quality);
  sub->get_option("--quality")->excludes("--memory");  // as --samples, which presets set
  sub->footer("Reads " + readable_formats() + ", each also gzipped. " + kConvertExamples);
  sub->callback([arguments, quality, sub, &command] {
    check_together(*arguments);
    if (*quality) {
      set_conversion(values_not_given(preset_of(**quality).convert, *sub), arguments->options,
                     arguments->file);
    }
    command = [arguments] { return run_convert(*arguments); };
  });
}

}  // namespace relief::cli
