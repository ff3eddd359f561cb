// relief convert: a scan becomes a patch file.
#include "preprocess/convert.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/acquire.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/load.h"
#include "cli/options/paths.h"
#include "cli/reports/convert_report.h"
#include "common/patch_file/patch_file.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/points/outliers.h"
#include "preprocess/points/thin.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/maps/texture_maps.h"

namespace relief::cli {
namespace {

constexpr const char* kConvertExamples =
    "Several files become one model:\n"
    "they are taken as parts of one scan, in the frame that their coordinates are in. A .conf file "
    "(bun.conf)\n"
    "names range scans beside it and where each stands.\n"
    "In brackets: what is taken where an option is not given.\n"
    "\n"
    "Examples:\n"
    "  relief convert dragon.ply.gz -o dragon.relief\n"
    "  relief convert scan1.pcd scan2.pcd -o room.relief --spacing 0.01\n"
    "  relief convert range/bun.conf -o bunny.relief --clean\n"
    "  relief convert dragon.ply.gz -o dragon.relief --json > dragon.json";

struct ConvertArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::filesystem::path texture;  ///< as texture_choice has it
  ConvertOptions options;
  PatchFileOptions file;
  TileOptions tiles{.memory_bytes = 0};  ///< 0: as it takes, in one piece
  bool clean = false;
  double thin = 0.0;  ///< side of the cubes, scan's unit; 0: no thinning
  bool json = false;
};

/// Looks at what was written.
Result<ConvertSummary> summarise(const ConvertArguments& arguments, ConvertSummary summary) {
  RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(arguments.output));
  summary.file = file.info();
  return summary;
}

/// Converts in tiles; nothing if the scan is small enough for memory.
Result<std::optional<ConvertSummary>> convert_larger(const ConvertArguments& arguments,
                                                     Progress& progress) {
  RELIEF_TRY_ASSIGN(auto tiled, convert_tiles(arguments.inputs, arguments.output, arguments.options,
                                              arguments.file, arguments.tiles, progress));
  if (!tiled) return std::optional<ConvertSummary>();
  ConvertSummary summary;
  for (const std::string& text : tiled->notes) note(text);
  summary.report = tiled->report;
  summary.read.dropped_nonfinite = tiled->nonfinite;
  summary.read.left_out = tiled->left_out;
  summary.read.merged_duplicates = tiled->duplicates;
  summary.tiled = std::move(*tiled);
  RELIEF_TRY_ASSIGN(auto done, summarise(arguments, std::move(summary)));
  return std::optional(std::move(done));
}

/// Reads, converts and writes.
Result<ConvertSummary> convert_files(const ConvertArguments& arguments, Progress& progress) {
  if (arguments.tiles.memory_bytes > 0) {
    RELIEF_TRY_ASSIGN(auto larger, convert_larger(arguments, progress));
    if (larger) return std::move(*larger);
  }
  RELIEF_TRY_ASSIGN(auto read,
                    load_points(arguments.inputs, texture_choice(arguments.texture), progress));
  ConvertSummary summary;
  if (arguments.clean) summary.outliers = remove_outliers(read.points, progress);
  if (summary.outliers.were_too_many)
    note("more than half of the points look like outliers; --clean took none away");
  if (progress.cancelled()) return interrupted_error();
  if (arguments.thin > 0.0) summary.thinned = thin_points(read.points, arguments.thin);
  auto converted = convert(std::move(read.points), arguments.options, progress);
  if (!converted) {
    return make_error("{}: {}", arguments.inputs.front().string(), converted.error().message);
  }
  // The last moment at which nothing is there yet; writing takes well under a second.
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("write", 0);
  if (const Status written = write_patch_file(arguments.output, converted->model, arguments.file);
      !written) {
    return written.error();
  }
  summary.read = std::move(read);
  summary.report = converted->report;
  return summarise(arguments, std::move(summary));
}

std::vector<std::filesystem::path> files_read(const ConvertArguments& arguments) {
  std::vector<std::filesystem::path> files = arguments.inputs;
  if (!arguments.texture.empty()) files.push_back(arguments.texture);
  return files;
}

/// What is left of a conversion that ended early.
std::string kept_by(const ConvertArguments& arguments) {
  const auto kept = find_kept_tiles(arguments.output);
  if (arguments.tiles.memory_bytes == 0 || !kept) return {};
  return fmt::format("what is done is kept in {}, and the same command goes on from there",
                     kept->string());
}

int run_convert(const ConvertArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  if (const Status writable = check_output(arguments.output, files_read(arguments)); !writable) {
    return fail(writable.error());
  }
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
  return arguments.json ? print_json(convert_json(*summary))
                        : print_result(convert_text(*summary, arguments.output));
}

}  // namespace

void add_convert(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("convert", "Convert a scan to a patch file");
  const auto arguments = std::make_shared<ConvertArguments>();
  sub->add_option("IN", arguments->inputs, "Scan or mesh files")
      ->required()
      ->option_text("FILE...");
  sub->add_option("-o,--output", arguments->output, "The patch file to write (.relief)")
      ->required()
      ->option_text("FILE (required)");
  sub->add_option(
         "--spacing", arguments->options.spacing,
         "Grid step in the scan's unit: smaller is more exact and makes a larger file (about as "
         "many samples as points)")
      ->check(CLI::PositiveNumber)
      ->option_text("S");
  sub->add_option("--height-step", arguments->options.height_step,
                  "What heights are rounded to, in the scan's unit: larger makes a smaller file (a "
                  "twentieth of the spacing)")
      ->check(CLI::PositiveNumber)
      ->option_text("S");
  auto* const adaptive = sub->add_flag(
      "--adaptive-spacing", arguments->options.adaptive_spacing,
      "Each patch's spacing follows the scan's density there, up to 8 to 1; --spacing is "
      "then that of the usual density");
  sub->add_option("--codec", arguments->file.codec,
                  "fast: quickest to read and write; compact: about half the bytes of heights, and "
                  "coarse levels that can be read alone (fast)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, PatchCodec>{
          {"fast", PatchCodec::Fast}, {"compact", PatchCodec::Compact}}))
      ->option_text("fast|compact");
  sub->add_option("--normal-degrees", arguments->file.normal_degrees,
                  "With --codec compact: how far normals may be off (0.5); what is as near to the "
                  "normals of the heights is not kept at all")
      ->check(CLI::Range(kMinNormalDegrees, kMaxNormalDegrees))
      ->option_text("DEG");
  auto* const clean = sub->add_flag(
      "--clean", arguments->clean,
      "Take away outliers: points far from their neighbours, and clusters of fewer than 50");
  auto* const thin =
      sub->add_option("--thin", arguments->thin,
                      "Take away all points but one in each cube of this side, in the scan's unit")
          ->check(CLI::PositiveNumber)
          ->option_text("S");
  sub->add_option("--cone-degrees", arguments->options.cone_degrees,
                  "Largest angle between a patch's normal and its points' normals; larger makes "
                  "fewer patches")
      ->check(CLI::Range(1.0, 89.0))
      ->option_text("DEG");
  sub->add_option(
         "--overlap", arguments->options.overlap_cells,
         fmt::format("Grid cells by which patches overlap ({})", arguments->options.overlap_cells))
      ->check(CLI::Range(0, 16))
      ->option_text("CELLS");
  sub->add_option("--texture", arguments->texture,
                  "Picture that a mesh's texture coordinates refer to, in place of its file's own; "
                  "and none of its normal maps; none: neither")
      ->option_text("FILE|none");
  sub->add_option("--texels-per-cell", arguments->options.texels_per_cell,
                  "Texels of colour and normal maps along a grid cell's side, of a mesh with a "
                  "texture (a power of "
                  "two for each patch that keeps the texture's own)")
      ->check(CLI::Range(1U, kMaxTexelsPerCell))
      ->option_text("N");
  auto* const memory =
      sub->add_option(
             "--memory", arguments->tiles.memory_bytes,
             "Most memory to take, 256M or more: a scan that needs more is converted in tiles, "
             "kept in OUT.parts until the end; if it is stopped or killed the same command "
             "goes on from there. Triangles and textures are not used then (as it takes)")
          ->excludes(adaptive)
          ->excludes(clean)
          ->excludes(thin)
          ->transform(CLI::AsSizeValue(false))
          ->check(CLI::Range(kMinTileMemory, std::uint64_t{1} << 50U))
          ->option_text("BYTES");
  sub->add_flag_callback(
         "--no-overviews", [arguments] { arguments->tiles.overviews = false; },
         "With --memory: without coarser patches over the model's own, by which a large "
         "model is drawn from afar without reading all of it; two sevenths fewer bytes")
      ->needs(memory);
  sub->add_option("--threads", arguments->options.threads,
                  "Threads; the file is the same with any number (all cores)")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer("Reads " + readable_formats() + ", each also gzipped. " + kConvertExamples);
  sub->callback(
      [arguments, &command] { command = [arguments] { return run_convert(*arguments); }; });
}

}  // namespace relief::cli
