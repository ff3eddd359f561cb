#include "cli/options/texture_options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "cli/options/values.h"

namespace relief::cli {
namespace {

const std::map<std::string, Acquisition> kAcquisitions{{"given", Acquisition::Given},
                                                       {"ewa", Acquisition::ViewIndependent},
                                                       {"optimised", Acquisition::Optimised}};

/// Memory allows fewer, which is checked once the mesh is known.
constexpr std::uint32_t kMostSplats = 1'000'000'000;

}  // namespace

TextureChoice texture_choice(const std::filesystem::path& option, bool flips_v) {
  if (option == "none") return {true, {}, flips_v};
  return {false, option, flips_v};
}

void add_flip_option(CLI::App& sub, bool& flips_v) {
  sub.add_flag("--flip-v", flips_v,
               "Let texture coordinates count from the picture's upper edge, for a mesh whose "
               "picture is upside down");
}

void add_texture_options(CLI::App& sub, TextureArguments& arguments) {
  auto* const texture =
      sub.add_option(
             "--texture", arguments.file,
             "Image that the mesh's texture coordinates refer to, in place of the file's "
             "own; none: no texture; ewa spreads splats over the faces (default: the file's "
             "own)")
          ->option_text("FILE|none");
  add_flip_option(sub, arguments.flips_v);
  sub.add_option(
         "--acquisition", arguments.acquisition,
         "ewa: how splats get the texture's colours: given takes its value at the point, ewa "
         "its mean under the splat, optimised the nearest fit (default optimised)")
      ->check(CLI::IsMember(kAcquisitions))
      ->option_text("given|ewa|optimised")
      ->needs(texture);
  sub.add_option("--points", arguments.points,
                 "ewa: number of splats for a --texture, 1 to 1000000000 (default 100000)")
      ->check(count_from(1, kMostSplats))
      ->option_text("N")
      ->needs(texture);
}

LoadOptions load_options(const TextureArguments& arguments) {
  LoadOptions options;
  options.textures = texture_choice(arguments.file, arguments.flips_v);
  if (arguments.acquisition)
    options.acquisition.acquisition = kAcquisitions.at(*arguments.acquisition);
  options.acquisition.points = arguments.points.value_or(options.acquisition.points);
  return options;
}

}  // namespace relief::cli
