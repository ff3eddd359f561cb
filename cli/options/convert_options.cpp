#include "cli/options/convert_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "cli/options/output_file.h"
#include "cli/options/read_options.h"
#include "cli/options/texture_options.h"
#include "cli/options/values.h"
#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "preprocess/sample_search.h"
#include "preprocess/texture/maps/texture_maps.h"

namespace relief::cli {
namespace {

constexpr std::uint64_t kFewestSamples = 64;
constexpr std::uint64_t kMostSamples = 1'000'000'000'000;
/// Fewer leave patches of a few samples each.
constexpr double kFewestSamplesForPoint = 0.001;
/// Heights of one step a spacing are a staircase; a thousandth of a spacing is far below any noise.
constexpr double kFewestStepsPerSpacing = 1.0;
constexpr double kMostStepsPerSpacing = 1000.0;

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
  CLI::Option* const density =
      sub.add_option(
             "--samples-per-point", arguments.options.samples_per_point,
             fmt::format("Make about so many samples for each point, {:g} to {:g} (default: "
                         "as --spacing has it)",
                         kFewestSamplesForPoint, kFinestSamplesPerPoint))
          ->check(number_from(kFewestSamplesForPoint, kFinestSamplesPerPoint))
          ->excludes(spacing)
          ->excludes(samples)
          ->option_text("F");
  sub.add_option("--error", arguments.options.error,
                 "Make the fewest samples from which the points lie at most so far, rms, in the "
                 "scan's unit, above 0; converts up to eight times (default: as --spacing has it)")
      ->check(positive_number())
      ->excludes(spacing)
      ->excludes(samples)
      ->excludes(density)
      ->option_text("E");
  CLI::Option* const step =
      sub.add_option("--height-step", arguments.options.height_step,
                     "Step that heights are rounded to, in the scan's unit, above 0 (default: as "
                     "--steps-per-spacing has it)")
          ->check(positive_number())
          ->option_text("S");
  sub.add_option("--steps-per-spacing", arguments.options.steps_per_spacing,
                 fmt::format("Steps that heights are rounded to, in each patch's spacing, {:g} to "
                             "{:g} (default {:g})",
                             kFewestStepsPerSpacing, kMostStepsPerSpacing, kUsualStepsPerSpacing))
      ->check(number_from(kFewestStepsPerSpacing, kMostStepsPerSpacing))
      ->excludes(step)
      ->option_text("N");
  CLI::Option* const adaptive = sub.add_flag_callback(
      "--adaptive-spacing", [&arguments] { arguments.options.adaptive_spacing = true; },
      "Fit each patch's spacing to the density of its points; --spacing is then that of the median "
      "density (default for points without faces whose density varies, except with --spacing and "
      "--memory)");
  sub.add_flag_callback(
         "--even-spacing", [&arguments] { arguments.options.adaptive_spacing = false; },
         "Give all patches one spacing (default for points without faces, unless their density "
         "varies)")
      ->excludes(adaptive);
  sub.add_option(
         "--cone-degrees", arguments.options.cone_degrees,
         "Largest angle between the normal of a patch and of its points, in degrees, 1 to 89; "
         "larger makes fewer patches (default 70)")
      ->check(number_from(1.0, 89.0))
      ->option_text("DEG");
  CLI::Option* const seams = sub.add_flag_callback(
      "--seams", [&arguments] { arguments.options.seams = true; },
      "End patches at common seams instead of letting them overlap; with --memory they still "
      "overlap from tile to tile (default for scans with faces, and for points of bodies that are "
      "closed or have sharp edges, except with --memory)");
  sub.add_option_function<int>(
         "--overlap",
         [&arguments](int cells) {
           arguments.options.seams = false;
           arguments.options.overlap_cells = cells;
         },
         fmt::format("Let patches overlap by so many grid cells, 0 to 16 (default {} for other "
                     "points)",
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
      arguments.tiles.read.scalars.all = true;
    } else if (name == kDistanceScalar) {
      arguments.options.distances = true;
    } else {
      arguments.tiles.read.scalars.names.push_back(name);
    }
  }
  if (arguments.tiles.read.scalars.names.size() > kMaxScalars)
    throw CLI::ValidationError("--scalars", fmt::format("names more than {}", kMaxScalars));
}

/// Adds the options of the patch file.
void add_file_options(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option_function<std::string>(
         "--up", [&arguments](const std::string& s) { arguments.options.up = parse_up(s); },
         "Up direction of the model, which images of it have (default: z for points, y for meshes, "
         "and as the sensor stood for PCD)")
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
             "its triangles and textures; tiles are kept in OUT.parts until the end, so that the "
             "same command resumes an interrupted conversion (default: no limit)")
          ->excludes("--adaptive-spacing")
          ->excludes("--samples")
          ->excludes("--samples-per-point")
          ->excludes("--error")
          ->excludes("--clean")
          ->excludes("--thin")
          ->transform(CLI::AsSizeValue(false))
          ->check(bytes_from(kMinTileMemory))
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

void add_convert_options(CLI::App& sub, ConvertArguments& arguments) {
  sub.add_option("IN", arguments.inputs,
                 "Scan, mesh or raster files; several scans become one model; -: standard input")
      ->required()
      ->option_text("FILE...");
  sub.add_option("-o,--output", arguments.output,
                 "Patch file to write (.relief); -: standard output")
      ->required()
      ->check(patch_file_name())
      ->option_text("FILE (required)");
  add_surface_options(sub, arguments);
  add_point_options(sub, arguments);
  add_read_options(sub, arguments.tiles.read);
  add_scalar_option(sub, arguments);
  add_file_options(sub, arguments);
  add_texture_options(sub, arguments);
  add_resource_options(sub, arguments);
  sub.add_flag("--json", arguments.json, "Print one JSON object on standard output");
}

void check_together(const ConvertArguments& arguments) {
  check_json(arguments.output, arguments.json);
  if (arguments.output == kStandardName && arguments.tiles.memory_bytes > 0) {
    throw CLI::ValidationError("--memory",
                               "keeps tiles beside its output; name a file instead of --output -");
  }
}

}  // namespace relief::cli
