// relief convert: a scan becomes a patch file.
#include "preprocess/convert.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/output_file.h"
#include "cli/options/paths.h"
#include "cli/options/read_options.h"
#include "cli/options/texture_options.h"
#include "cli/options/values.h"
#include "cli/reports/convert_report.h"
#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "common/patch_file/patch_file.h"
#include "loader/load_files.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/points/outliers.h"
#include "preprocess/points/thin.h"
#include "preprocess/raster/convert_raster.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/maps/texture_maps.h"

namespace relief::cli {
namespace {

constexpr std::uint64_t kFewestSamples = 64;
constexpr std::uint64_t kMostSamples = 1'000'000'000'000;

constexpr const char* kConvertExamples =
    "Several files are parts of one scan, in one\n"
    "frame. A .conf file (bun.conf) names range scans beside it and the pose of each.\n"
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
  bool flips_v = false;
  ConvertOptions options;
  PatchFileOptions file;
  TileOptions tiles{.memory_bytes = 0};  ///< 0: no limit, in one piece
  ScalarChoice scalars;                  ///< of the files
  bool clean = false;
  double thin = 0.0;  ///< side of the cubes, scan's unit; 0: no thinning
  bool json = false;
};

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
  ReadOptions options = arguments.tiles.read;
  options.scalars = arguments.scalars;
  RELIEF_TRY_ASSIGN(
      auto read, load_points(arguments.inputs, texture_choice(arguments.texture, arguments.flips_v),
                             progress, options));
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

/// The patches.
void add_surface_options(CLI::App& sub, ConvertArguments& arguments) {
  CLI::Option* const spacing =
      sub.add_option(
             "--spacing", arguments.options.spacing,
             "Distance between samples, in the scan's unit, above 0 (default: such that there are "
             "about as many samples as points, or up to twice as many where a mesh bends)")
          ->check(positive_number())
          ->option_text("S");
  CLI::Option* const samples =
      sub.add_option("--samples", arguments.options.samples,
                     "Make about so many samples, 64 or more, at most 4 for each point (default: "
                     "as --spacing has it)")
          ->check(count_from(kFewestSamples, kMostSamples))
          ->excludes(spacing)
          ->option_text("N");
  sub.add_option("--error", arguments.options.error,
                 "Make the fewest samples from which the points lie at most so far, rms, in the "
                 "scan's unit, above 0; converts up to six times (default: as --spacing has it)")
      ->check(positive_number())
      ->excludes(spacing)
      ->excludes(samples)
      ->option_text("E");
  sub.add_option(
         "--height-step", arguments.options.height_step,
         "Step that heights are rounded to, in the scan's unit, above 0 (default: spacing / 20)")
      ->check(positive_number())
      ->option_text("S");
  sub.add_flag(
      "--adaptive-spacing", arguments.options.adaptive_spacing,
      "Fit each patch's spacing to the local density of points, up to 8 to 1; --spacing is "
      "then that of the median density");
  sub.add_option(
         "--cone-degrees", arguments.options.cone_degrees,
         "Largest angle between the normal of a patch and of its points, in degrees, 1 to 89; "
         "larger makes fewer patches (default 70)")
      ->check(number_from(1.0, 89.0))
      ->option_text("DEG");
  CLI::Option* const seams = sub.add_flag_callback(
      "--seams", [&arguments] { arguments.options.seams = true; },
      "End patches at common seams instead of letting them overlap; with --memory they still "
      "overlap from tile to tile (default for scans with faces, except with --memory)");
  sub.add_option_function<int>(
         "--overlap",
         [&arguments](int cells) {
           arguments.options.seams = false;
           arguments.options.overlap_cells = cells;
         },
         fmt::format("Let patches overlap by so many grid cells, 0 to 16 (default {} for scans "
                     "without faces)",
                     arguments.options.overlap_cells))
      ->excludes(seams)
      ->check(count_from(0, 16))
      ->option_text("CELLS");
}

/// Refuses a name that does not end in .relief: `relief convert a.ply b.ply -o c.ply` would replace
/// a scan.
CLI::Validator patch_file_name() {
  const auto complain = [](const std::string& name) {
    return lower_extension(name) == ".relief" || name == kStandardName
               ? std::string()
               : "expected a name that ends in .relief; found " + name;
  };
  return {complain, ""};
}

/// Refuses what is less than tiles need. Sees bytes, whatever unit the user chose.
CLI::Validator memory_limit() {
  const auto complain = [](const std::string& text) {
    const auto bytes = parse_number(text);
    return bytes && *bytes >= static_cast<double>(kMinTileMemory) && *bytes <= 0x1p50
               ? std::string()
               : fmt::format("expected 256M or more; found {} bytes", text);
  };
  return {complain, ""};
}

/// Sets the noise to remove: auto, 0 or a standard deviation of at most 1e100.
void read_noise(const std::string& text, ConvertOptions& options) {
  options.noise_removal = NoiseRemoval::AsMeasured;
  if (text == "auto") return;
  const std::optional<double> noise = parse_number(text);
  if (!noise || !(*noise >= 0.0 && *noise <= 1e100)) {
    throw CLI::ValidationError(
        "--noise", fmt::format("expected auto or a number from 0 to 1e100; found {}", text));
  }
  options.noise = *noise;
  options.noise_removal = *noise > 0.0 ? NoiseRemoval::AsGiven : NoiseRemoval::None;
}

/// Sets the side that normals face: auto, up, outward or toward=X,Y,Z.
void read_side(const std::string& text, SideChoice& choice) {
  const std::string_view toward = "toward=";
  if (text.starts_with(toward)) {
    choice = {NormalSide::Toward, parse_vector(text.substr(toward.size()))};
    return;
  }
  const std::map<std::string, NormalSide> sides{
      {"auto", NormalSide::Auto}, {"up", NormalSide::Up}, {"outward", NormalSide::Outward}};
  const auto found = sides.find(text);
  if (found == sides.end()) {
    throw CLI::ValidationError(
        "--normals",
        fmt::format("expected auto, up, outward or toward=X,Y,Z, as in toward=0,0,1.5; found {}",
                    text));
  }
  choice = {found->second, {}};
}

/// Adds the options that select points and say how exact they are.
void add_point_options(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option_function<std::string>(
         "--noise", [&arguments](const std::string& text) { read_noise(text, arguments.options); },
         "Noise to remove: its standard deviation along the normal, in the scan's unit; auto "
         "measures it, 0 keeps it (default: auto for scans without faces, 0 for meshes)")
      ->option_text("auto|0|S");
  sub.add_option_function<std::string>(
         "--normals",
         [&arguments](const std::string& text) { read_side(text, arguments.options.side); },
         "Side that normals of points face: up (+Z), outward, or towards a position, also if the "
         "file gives normals; auto: towards the scanner if the file tells where it was, up if the "
         "scan looks airborne, otherwise outward, and given normals stay; faces keep their side "
         "(default auto)")
      ->option_text("auto|up|outward|toward=X,Y,Z");
  sub.add_flag("--clean", arguments.clean,
               "Remove outliers: points far from their neighbours, and clusters of fewer than 50 "
               "points");
  sub.add_option(
         "--thin", arguments.thin,
         "Keep one point in each cube of side S, in the scan's unit, above 0 (default: keeps "
         "all)")
      ->check(positive_number())
      ->option_text("S");
}

/// Sets the scalars to keep: names, of which distance is computed, or all of the files.
void read_scalars(const std::string& text, ConvertArguments& arguments) {
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string name = canonical_scalar_name(text.substr(at, end - at));
    at = end + 1;
    if (name.empty())
      throw CLI::ValidationError("--scalars", "expected names with commas between; found " + text);
    if (name == kHeightScalar) {
      throw CLI::ValidationError("--scalars",
                                 "height needs no scalar: `relief render --colour-by height` takes "
                                 "it from the surface");
    }
    if (name == "all") {
      arguments.scalars.all = true;
    } else if (name == kDistanceScalar) {
      arguments.options.distances = true;
    } else {
      arguments.scalars.names.push_back(name);
    }
  }
  if (arguments.scalars.names.size() > kMaxScalars)
    throw CLI::ValidationError("--scalars", fmt::format("names more than {}", kMaxScalars));
}

/// Adds the options of the patch file.
void add_file_options(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option_function<std::string>(
         "--up", [&arguments](const std::string& s) { arguments.options.up = parse_up(s); },
         "Up direction of the model, which images of it have (default: z for LAS, PTX and XYZ, "
         "that "
         "of the sensor for PCD, y for others)")
      ->option_text("x|y|z|-x|-y|-z|X,Y,Z");
  sub.add_option(
         "--codec", arguments.file.codec,
         "Codec: fast reads and writes quickest; compact halves the bytes of heights, and its "
         "coarse levels can be read separately (default fast)")
      ->transform(one_of(std::map<std::string, PatchCodec>{{"fast", PatchCodec::Fast},
                                                           {"compact", PatchCodec::Compact}}))
      ->option_text("fast|compact");
  sub.add_option("--normal-degrees", arguments.file.normal_degrees,
                 fmt::format("Largest error of normals, in degrees, {:g} to {:g}, with --codec "
                             "compact; normals this near to those of the heights are not stored "
                             "(default {:g})",
                             kMinNormalDegrees, kMaxNormalDegrees, arguments.file.normal_degrees))
      ->check(number_from(kMinNormalDegrees, kMaxNormalDegrees))
      ->option_text("DEG");
}

void add_scalar_option(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option_function<std::string>(
         "--scalars", [&arguments](const std::string& text) { read_scalars(text, arguments); },
         "Scalars to keep for `relief render --colour-by`: names such as intensity, "
         "classification, return_number or gps_time; distance, to the nearest point; all: those of "
         "the file (default: none)")
      ->option_text("NAME,...|all");
}

void add_texture_options(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option(
         "--texture", arguments.texture,
         "Image that the mesh's texture coordinates refer to, in place of the file's own images "
         "and normal maps; none: no textures (default: the file's own)")
      ->option_text("FILE|none");
  add_flip_option(sub, arguments.flips_v);
  sub.add_option(
         "--texels-per-cell", arguments.options.texels_per_cell,
         fmt::format("Texels of colour and normal maps along the side of a grid cell, for a mesh "
                     "with textures, 1 to {} (default: the power of two that keeps the "
                     "texture's resolution, patch by patch)",
                     kMaxTexelsPerCell))
      ->check(count_from(1, kMaxTexelsPerCell))
      ->option_text("N");
}

void add_resource_options(CLI::App& sub, ConvertArguments& arguments) {
  auto* const memory =
      sub.add_option(
             "--memory", arguments.tiles.memory_bytes,
             "Memory limit, 256M or more. A scan that needs more is converted in tiles, without "
             "its triangles, textures and scalars; tiles are kept in OUT.parts until the end, so "
             "that "
             "the same command resumes an interrupted conversion (default: no limit)")
          ->excludes("--adaptive-spacing")
          ->excludes("--samples")
          ->excludes("--error")
          ->excludes("--clean")
          ->excludes("--noise")
          ->excludes("--thin")
          ->excludes("--scalars")
          ->transform(CLI::AsSizeValue(false))
          ->check(memory_limit())
          ->option_text("BYTES");
  sub.add_flag_callback(
         "--no-overviews", [&arguments] { arguments.tiles.overviews = false; },
         "With --memory: leave out the coarse patches over the tiles, which let a large model be "
         "drawn "
         "from afar without reading all of it; saves two sevenths of the bytes")
      ->needs(memory);
  sub.add_option(
         "--threads", arguments.options.threads,
         "Threads, 1 to 1024; the file does not depend on them (default: one for each core)")
      ->check(count_from(1, 1024))
      ->option_text("N");
}

}  // namespace

void add_convert(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("convert", "Convert a scan or mesh to a patch file");
  const auto arguments = std::make_shared<ConvertArguments>();
  sub->add_option("IN", arguments->inputs,
                  "Scan, mesh or raster files; several scans become one model; -: standard input")
      ->required()
      ->option_text("FILE...");
  sub->add_option("-o,--output", arguments->output,
                  "Patch file to write (.relief); -: standard output")
      ->required()
      ->check(patch_file_name())
      ->option_text("FILE (required)");
  add_surface_options(*sub, *arguments);
  add_point_options(*sub, *arguments);
  add_read_options(*sub, arguments->tiles.read);
  add_scalar_option(*sub, *arguments);
  add_file_options(*sub, *arguments);
  add_texture_options(*sub, *arguments);
  add_resource_options(*sub, *arguments);
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer("Reads " + readable_formats() + ", each also gzipped. " + kConvertExamples);
  sub->callback([arguments, &command] {
    check_json(arguments->output, arguments->json);
    if (arguments->output == kStandardName && arguments->tiles.memory_bytes > 0) {
      throw CLI::ValidationError(
          "--memory", "keeps tiles beside its output; name a file instead of --output -");
    }
    command = [arguments] { return run_convert(*arguments); };
  });
}

}  // namespace relief::cli
