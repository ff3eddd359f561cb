#include "cli/options/texture_options.h"

#include <CLI/CLI.hpp>
#include <map>

namespace relief::cli {
namespace {

const std::map<std::string, Acquisition> kAcquisitions{{"given", Acquisition::Given},
                                                       {"ewa", Acquisition::ViewIndependent},
                                                       {"optimised", Acquisition::Optimised}};

}  // namespace

TextureChoice texture_choice(const std::filesystem::path& option) {
  if (option == "none") return {true, {}};
  return {false, option};
}

void add_texture_options(CLI::App& sub, TextureArguments& arguments) {
  auto* const texture =
      sub.add_option("--texture", arguments.file,
                     "Picture that a mesh's texture coordinates refer to, in place of its file's "
                     "own; none: no texture. ewa: splats are spread over the faces")
          ->option_text("FILE|none");
  sub.add_option("--acquisition", arguments.acquisition,
                 "ewa: how splats get the texture's colours: given is its value at the point, ewa "
                 "its mean under the splat, optimised what comes nearest to it (optimised)")
      ->check(CLI::IsMember(kAcquisitions))
      ->option_text("given|ewa|optimised")
      ->needs(texture);
  sub.add_option("--points", arguments.points, "ewa: splats for a --texture (100000)")
      ->check(CLI::PositiveNumber)
      ->option_text("N")
      ->needs(texture);
}

LoadOptions load_options(const TextureArguments& arguments) {
  LoadOptions options;
  options.textures = texture_choice(arguments.file);
  if (arguments.acquisition)
    options.acquisition.acquisition = kAcquisitions.at(*arguments.acquisition);
  options.acquisition.points = arguments.points.value_or(options.acquisition.points);
  return options;
}

}  // namespace relief::cli
