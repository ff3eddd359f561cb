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
#include <string>
#include <vector>

#include "cli/acquire.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/load.h"
#include "cli/paths.h"
#include "common/patch_file.h"
#include "preprocess/texture/texture_maps.h"

namespace relief::cli {
namespace {

constexpr const char* kExamples =
    "Reads PLY, PCD, LAS, PTX, OBJ, glTF, OFF, STL and XYZ text, each also gzipped. Several files "
    "become one model:\n"
    "they are taken as parts of one scan, in the frame that their coordinates are in.\n"
    "In brackets: what is taken where an option is not given.\n"
    "\n"
    "Examples:\n"
    "  relief convert dragon.ply.gz -o dragon.relief\n"
    "  relief convert scan1.pcd scan2.pcd -o room.relief --spacing 0.01\n"
    "  relief convert dragon.ply.gz -o dragon.relief --json > dragon.json";

struct Arguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::filesystem::path texture;  ///< as texture_choice has it
  ConvertOptions options;
  PatchFileOptions file;
  bool json = false;
};

/// Everything that `relief convert` measured.
struct Summary {
  ReadResult read;  ///< its points are gone: they were converted
  ConvertReport report;
  PatchFileInfo file;
  double seconds = 0.0;
  std::vector<ConsoleProgress::Stage> stages;
};

nlohmann::ordered_json as_json(const Summary& s) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& stage : s.stages) stages[stage.name] = stage.seconds;
  // nlohmann writes numbers that are not finite (the PSNR of a perfect plane) as null.
  return {{"points", s.report.points},
          {"points_dropped", s.read.dropped_nonfinite},
          {"points_left_out", s.read.left_out},
          {"duplicates_merged", s.read.merged_duplicates},
          {"normals_estimated", s.report.normals_estimated},
          {"points_added", s.report.points_added},
          {"normals_repaired", s.report.normals_repaired},
          {"patches", s.file.patches},
          {"samples", s.file.samples},
          {"spacing", s.file.spacing},
          {"file_bytes", s.file.file_bytes},
          {"height_bytes", s.file.height_bytes},
          {"normal_bytes", s.file.normal_bytes},
          {"colour_bytes", s.file.colour_bytes},
          {"seconds", s.seconds},
          {"error_rms", s.report.error_rms},
          {"error_max", s.report.error_max},
          {"psnr_db", s.report.psnr_db},
          {"uncovered_points", s.report.uncovered_points},
          {"texels_per_cell", s.report.texels_per_cell},
          {"colour_texels", s.report.colour_texels},
          {"normal_texels_per_cell", s.report.normal_texels_per_cell},
          {"normal_texels", s.report.normal_texels},
          {"stage_seconds", stages}};
}

std::string as_text(const Summary& s, const std::filesystem::path& output) {
  std::string normals = s.report.normals_estimated
                            ? "estimated"
                            : fmt::format("given, {} repaired", s.report.normals_repaired);
  if (s.report.normal_texels_per_cell > 1)
    normals += fmt::format("; {} texels, up to {} a cell along a side", s.report.normal_texels,
                           s.report.normal_texels_per_cell);
  const std::string colours = s.report.texels_per_cell == 0
                                  ? "none"
                                  : fmt::format("{} texels, up to {} a cell along a side",
                                                s.report.colour_texels, s.report.texels_per_cell);
  std::string text = fmt::format(
      "{}\n"
      "  points            {} ({} not finite dropped, {} duplicates merged)\n"
      "  normals           {}\n"
      "  patches           {}\n"
      "  samples           {}\n"
      "  spacing           {:.6g}\n"
      "  error             {:.3g} rms, {:.3g} at most\n"
      "  psnr              {:.2f} dB\n"
      "  uncovered points  {}\n"
      "  colours           {}\n"
      "  file              {} bytes, {:.2f} bits per sample\n"
      "  time              {:.2f} s",
      output.string(), s.report.points, s.read.dropped_nonfinite, s.read.merged_duplicates, normals,
      s.file.patches, s.file.samples, s.file.spacing, s.report.error_rms, s.report.error_max,
      s.report.psnr_db, s.report.uncovered_points, colours, s.file.file_bytes,
      8.0 * static_cast<double>(s.file.file_bytes) / static_cast<double>(s.file.samples),
      s.seconds);
  const char* separator = ": ";
  for (const auto& stage : s.stages) {
    text += fmt::format("{}{} {:.2f}", separator, stage.name, stage.seconds);
    separator = ", ";
  }
  return text + "\n";
}

/// Reads, converts, writes and looks at what was written.
Result<Summary> convert_files(const Arguments& arguments, Progress& progress) {
  auto read = load_points(arguments.inputs, texture_choice(arguments.texture), progress);
  if (!read) return read.error();
  auto converted = convert(std::move(read->points), arguments.options, progress);
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
  const auto file = PatchFile::open(arguments.output);
  if (!file) return file.error();
  Summary summary;
  summary.read = std::move(*read);
  summary.report = converted->report;
  summary.file = file->info();
  return summary;
}

std::vector<std::filesystem::path> files_read(const Arguments& arguments) {
  std::vector<std::filesystem::path> files = arguments.inputs;
  if (!arguments.texture.empty()) files.push_back(arguments.texture);
  return files;
}

int run(const Arguments& arguments) {
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
  if (!summary) return fail(summary.error());
  summary->stages = stages;
  summary->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return arguments.json ? print_json(as_json(*summary))
                        : print_result(as_text(*summary, arguments.output));
}

}  // namespace

void add_convert(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("convert", "Convert a scan to a patch file");
  const auto arguments = std::make_shared<Arguments>();
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
  sub->add_flag("--adaptive-spacing", arguments->options.adaptive_spacing,
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
      ->check(CLI::Range(kLeastNormalDegrees, kMostNormalDegrees))
      ->option_text("DEG");
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
      ->check(CLI::Range(1U, kMostTexelsPerCell))
      ->option_text("N");
  sub->add_option("--threads", arguments->options.threads,
                  "Threads; the file is the same with any number (all cores)")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kExamples);
  sub->callback([arguments, &command] { command = [arguments] { return run(*arguments); }; });
}

}  // namespace relief::cli
