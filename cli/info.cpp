// relief info: prints the contents of a patch file and checks every byte of it; counts clip
// partners.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/engine_options.h"
#include "cli/reports/clip_report.h"
#include "common/patch.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_tree.h"
#include "loader/count_clips.h"
#include "renderer/clip/options.h"

namespace relief::cli {
namespace {

constexpr const char* kInfoExamples =
    "Examples:\n"
    "  relief info dragon.relief\n"
    "  relief info dragon.relief --verify && echo all bytes are right\n"
    "  relief info part.ply --clip-partners --clip-normals refit";

struct InfoArguments {
  std::filesystem::path input;
  bool verify = false;
  bool json = false;
  bool clips = false;
  OptionValues clip_options = {};  ///< of clip_options()
};

/// A level of a file with tiles.
struct LevelSums {
  std::uint64_t tiles = 0;
  std::uint64_t patches = 0;
  std::uint64_t samples = 0;
  std::uint64_t bytes = 0;
  double spacing = 0.0;
};

/// From the model's own patches to the coarsest overview.
std::vector<LevelSums> levels_of(const PatchTree& tree) {
  std::vector<LevelSums> levels;
  for (const TreeTile& tile : tree.tiles()) {
    levels.resize(std::max<std::size_t>(levels.size(), tile.level + 1));
    LevelSums& level = levels[tile.level];
    ++level.tiles;
    level.patches += tile.patches;
    level.samples += tile.samples;
    level.bytes += tile.bytes;
    level.spacing = tile.spacing;
  }
  return levels;
}

/// The box about all samples of the model, coarser tiles left out.
Bounds drawn_bounds(const PatchTree& tree) {
  Bounds drawn;
  for (const TreeTile& tile : tree.tiles()) {
    if (tile.level > 0 || tile.box.empty()) continue;
    extend(drawn, tile.box.min);
    extend(drawn, tile.box.max);
  }
  return drawn;
}

/// Each with its range and three percentiles.
nlohmann::ordered_json scalars_as_json(const std::vector<ScalarInfo>& scalars) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ScalarInfo& scalar : scalars) {
    const Quantiles values = quantiles_of(scalar);
    json.push_back({{"name", scalar.name},
                    {"label", scalar.is_label},
                    {"min", values.front()},
                    {"p2", values[2]},
                    {"median", values[50]},
                    {"p98", values[98]},
                    {"max", values.back()}});
  }
  return json;
}

std::string scalars_as_text(const std::vector<ScalarInfo>& scalars) {
  std::string text;
  for (const ScalarInfo& scalar : scalars) {
    const Quantiles values = quantiles_of(scalar);
    text +=
        fmt::format("  scalar      {}: {:.9g} to {:.9g}, median {:.9g}{}\n", scalar.name,
                    values.front(), values.back(), values[50], scalar.is_label ? ", labels" : "");
  }
  return text;
}

nlohmann::ordered_json as_json(const PatchFileInfo& info, const Bounds& drawn,
                               const std::vector<LevelSums>& levels, bool verified) {
  const auto vector = [](glm::dvec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  // A file only tells that a model is closed, never that it is not.
  const auto closed = info.is_closed ? nlohmann::ordered_json(true) : nlohmann::ordered_json();
  nlohmann::ordered_json json = {{"version", info.version},
                                 {"codec", info.codec},
                                 {"patches", info.patches},
                                 {"samples", info.samples},
                                 {"levels", info.levels},
                                 {"spacing", info.spacing},
                                 {"file_bytes", info.file_bytes},
                                 {"height_bytes", info.height_bytes},
                                 {"normal_bytes", info.normal_bytes},
                                 {"colour_bytes", info.colour_bytes},
                                 {"bounds_min", vector(info.bounds.min)},
                                 {"bounds_max", vector(info.bounds.max)},
                                 {"drawn_min", vector(drawn.min)},
                                 {"drawn_max", vector(drawn.max)},
                                 {"scalar_bytes", info.scalar_bytes},
                                 {"attributes", info.attributes},
                                 {"scalars", scalars_as_json(info.scalars)},
                                 {"closed", closed},
                                 {"seams", info.is_joined},
                                 {"tiles", levels.front().tiles}};
  json["overviews"] = nlohmann::ordered_json::array();
  for (std::size_t l = 1; l < levels.size(); ++l) {
    json["overviews"].push_back({{"tiles", levels[l].tiles},
                                 {"patches", levels[l].patches},
                                 {"samples", levels[l].samples},
                                 {"spacing", levels[l].spacing},
                                 {"bytes", levels[l].bytes}});
  }
  if (verified) json["verified"] = true;
  return json;
}

/// "0 0 0 to 1 1 2"
std::string as_text(const Bounds& box) {
  return fmt::format("{:.9g} {:.9g} {:.9g} to {:.9g} {:.9g} {:.9g}", box.min.x, box.min.y,
                     box.min.z, box.max.x, box.max.y, box.max.z);
}

std::string as_text(const PatchFileInfo& info, const Bounds& drawn,
                    const std::vector<LevelSums>& levels, const InfoArguments& arguments) {
  std::string text = fmt::format(
      "{}{}\n"
      "  version     {}\n"
      "  codec       {}\n"
      "  patches     {}\n"
      "  samples     {}\n"
      "  spacing     {:.6g}\n"
      "  bounds      {} of the input\n"
      "  drawn       {}, with margins\n"
      "  attributes  {}\n"
      "{}"
      "  closed      {}\n"
      "  borders     {}\n"
      "  levels      {}\n"
      "  file        {} bytes: {} of heights, {} of normals, {} of colours, {} of scalars\n",
      arguments.input.string(), arguments.verify ? ": every byte is right" : "", info.version,
      info.codec, info.patches, info.samples, info.spacing, as_text(info.bounds), as_text(drawn),
      fmt::join(info.attributes, ", "), scalars_as_text(info.scalars),
      info.is_closed ? "yes" : "not known", info.is_joined ? "meet at seams" : "overlap",
      info.levels, info.file_bytes, info.height_bytes, info.normal_bytes, info.colour_bytes,
      info.scalar_bytes);
  if (levels.front().tiles > 1) text += fmt::format("  tiles       {}\n", levels.front().tiles);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    text += fmt::format(
        "  overview {}  {} tiles, {} patches, {} samples, spacing {:.6g}, {} bytes\n", l,
        levels[l].tiles, levels[l].patches, levels[l].samples, levels[l].spacing, levels[l].bytes);
  }
  return text;
}

/// Decodes every patch of every tile, one at a time, so that a file larger than memory can be
/// verified too.
Status verify(const PatchTree& tree, const std::string& name) {
  ConsoleProgress progress;
  std::uint64_t patches = 0;
  for (const TreeTile& tile : tree.tiles()) patches += tile.patches;
  progress.begin_stage("verify", patches);
  for (std::uint32_t t = 0; t < tree.tiles().size(); ++t) {
    RELIEF_TRY_ASSIGN(const auto file, tree.open_tile(t));
    std::uint64_t samples = 0;
    for (std::uint64_t i = 0; i < file.info().patches; ++i) {
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY_ASSIGN(const auto patch, file.read_patch(i));
      samples += count_samples(patch);
      progress.advance(1);
    }
    if (samples != file.info().samples) {
      return make_error(
          "{}: the header promises {} samples, the patches hold {}; the file is damaged", name,
          file.info().samples, samples);
    }
  }
  return {};
}

Result<ClipCounts> count_clips(const InfoArguments& arguments) {
  RenderSettings settings;
  for (const EngineOption& option : clip_options()) {
    const auto value = arguments.clip_options.find(option.row.key);
    if (value != arguments.clip_options.end()) option.set(settings, value->second);
  }
  settings.clip.rule = ClipRule::Partners;
  ConsoleProgress progress;
  return relief::count_clips(arguments.input, {}, settings.clip, progress);
}

/// Counts the clip partners of a scan, of which nothing else is printed.
int run_info_of_scan(const InfoArguments& arguments) {
  if (arguments.verify) {
    return fail(make_error("{}: only a patch file can be verified; leave out --verify",
                           arguments.input.string()));
  }
  const auto counts = count_clips(arguments);
  if (!counts) return fail(counts.error());
  return arguments.json ? print_json({{"clip", clips_as_json(*counts)}})
                        : print_result(arguments.input.string() + "\n" + clips_as_text(*counts));
}

int run_info(const InfoArguments& arguments) {
  if (const Status opened = open_inputs({arguments.input}); !opened) return fail(opened.error());
  if (arguments.clips && !names_patch_file(arguments.input)) return run_info_of_scan(arguments);
  const auto file = PatchFile::open(arguments.input);
  if (!file) return fail(file.error());
  const auto tree = PatchTree::open(arguments.input);
  if (!tree) return fail(tree.error());
  if (arguments.verify) {
    if (const Status right = verify(*tree, arguments.input.string()); !right) {
      return fail(right.error());
    }
  }
  const std::vector<LevelSums> levels = levels_of(*tree);
  const Bounds drawn = drawn_bounds(*tree);
  std::optional<ClipCounts> clips;
  if (arguments.clips) {
    const auto counted = count_clips(arguments);
    if (!counted) return fail(counted.error());
    clips = *counted;
  }
  if (!arguments.json) {
    return print_result(as_text(file->info(), drawn, levels, arguments) +
                        (clips ? clips_as_text(*clips) : std::string()));
  }
  nlohmann::ordered_json json = as_json(file->info(), drawn, levels, arguments.verify);
  if (clips) json["clip"] = clips_as_json(*clips);
  return print_json(json);
}

/// --clip-partners as a flag, and the options of how they are found as engines have them.
void add_clip_options(CLI::App& sub, InfoArguments& arguments) {
  CLI::Option* const flag =
      sub.add_flag("--clip-partners", arguments.clips,
                   "Count the clip partners of a patch file or a scan, as engine ewa draws it");
  for (const EngineOption& option : clip_options()) {
    if (option.row.key == "clip-partners") continue;
    add_engine_option(sub, arguments.clip_options, {option.row, {}, {}})->needs(flag);
  }
}

}  // namespace

void add_info(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("info", "Print what a patch file holds");
  const auto arguments = std::make_shared<InfoArguments>();
  sub->add_option("PATCHES", arguments->input,
                  "Patch file (.relief); -: standard input; with --clip-partners a scan, too")
      ->required()
      ->option_text("FILE");
  sub->add_flag("--verify", arguments->verify,
                "Decode the whole file; exit code 1 if any byte is wrong");
  add_clip_options(*sub, *arguments);
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kInfoExamples);
  sub->callback([arguments, &command] { command = [arguments] { return run_info(*arguments); }; });
}

}  // namespace relief::cli
