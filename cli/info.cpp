// relief info: what a patch file holds, and whether every byte of it is right.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "cli/console.h"
#include "common/patch.h"
#include "common/patch_file.h"

namespace relief::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  relief info dragon.relief\n"
    "  relief info dragon.relief --verify && echo all bytes are right";

struct Arguments {
  std::filesystem::path input;
  bool verify = false;
  bool json = false;
};

nlohmann::ordered_json as_json(const PatchFileInfo& info, bool verified) {
  const auto vector = [](glm::dvec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
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
                                 {"attributes", info.attributes},
                                 {"closed", info.is_closed}};
  if (verified) json["verified"] = true;
  return json;
}

std::string as_text(const PatchFileInfo& info, const Arguments& arguments) {
  const auto& low = info.bounds.min;
  const auto& high = info.bounds.max;
  return fmt::format(
      "{}{}\n"
      "  version     {}\n"
      "  codec       {}\n"
      "  patches     {}\n"
      "  samples     {}\n"
      "  spacing     {:.6g}\n"
      "  bounds      {:.9g} {:.9g} {:.9g} to {:.9g} {:.9g} {:.9g}\n"
      "  attributes  {}\n"
      "  closed      {}\n"
      "  levels      {}\n"
      "  file        {} bytes: {} of heights, {} of normals, {} of colours\n",
      arguments.input.string(), arguments.verify ? ": every byte is right" : "", info.version,
      info.codec, info.patches, info.samples, info.spacing, low.x, low.y, low.z, high.x, high.y,
      high.z, fmt::join(info.attributes, ", "), info.is_closed ? "yes" : "not known", info.levels,
      info.file_bytes, info.height_bytes, info.normal_bytes, info.colour_bytes);
}

/// Decodes every patch, one at a time, so that a file larger than memory can be verified too.
Status verify(const PatchFile& file, const std::string& name) {
  ConsoleProgress progress;
  progress.begin_stage("verify", file.info().patches);
  std::uint64_t samples = 0;
  for (std::uint64_t i = 0; i < file.info().patches; ++i) {
    if (progress.cancelled()) return interrupted_error();
    const auto patch = file.read_patch(i);
    if (!patch) return patch.error();
    samples += count_samples(*patch);
    progress.advance(1);
  }
  if (samples != file.info().samples) {
    return make_error(
        "{}: the header promises {} samples, the patches hold {}; the file is damaged", name,
        file.info().samples, samples);
  }
  return {};
}

int run(const Arguments& arguments) {
  const auto file = PatchFile::open(arguments.input);
  if (!file) return fail(file.error());
  if (arguments.verify) {
    if (const Status right = verify(*file, arguments.input.string()); !right) {
      return fail(right.error());
    }
  }
  return arguments.json ? print_json(as_json(file->info(), arguments.verify))
                        : print_result(as_text(file->info(), arguments));
}

}  // namespace

void add_info(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("info", "Tell what a patch file holds");
  const auto arguments = std::make_shared<Arguments>();
  sub->add_option("PATCHES", arguments->input, "A patch file (.relief)")
      ->required()
      ->option_text("FILE");
  sub->add_flag("--verify", arguments->verify,
                "Decode everything; exit code 1 if any byte is wrong");
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kExamples);
  sub->callback([arguments, &command] { command = [arguments] { return run(*arguments); }; });
}

}  // namespace relief::cli
