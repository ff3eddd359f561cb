#include "cli/acquire.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <utility>

#include "cli/console.h"
#include "common/image/image_io.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/acquisition/acquire_texture.h"

namespace relief::cli {
namespace {

const std::map<std::string, Acquisition> kAcquisitions{{"given", Acquisition::Given},
                                                       {"ewa", Acquisition::ViewIndependent},
                                                       {"optimised", Acquisition::Optimised}};

std::string describe(const AcquireResult& acquired) {
  const AcquireReport& report = acquired.report;
  std::string text =
      fmt::format("texture: {} splats of {:.3g} texels each, rms error {:.4f} in linear light",
                  acquired.splats.positions.size(), report.texels_per_point, report.rms_error);
  if (report.fit) {
    text += fmt::format("; residual {:.1e} after {} steps", report.fit->residual,
                        report.fit->iterations);
    if (report.fit->condition) text += fmt::format(", condition {:.3g}", *report.fit->condition);
  }
  return text;
}

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

Result<SplatCloud> acquire_splats(const std::filesystem::path& mesh,
                                  const TextureArguments& arguments, double cutoff,
                                  Progress& progress) {
  const auto texture = read_image(arguments.file);
  if (!texture) return texture.error();
  auto scan = read_points(mesh, progress);
  if (!scan) return scan.error();
  AcquireOptions options;
  options.acquisition = kAcquisitions.at(arguments.acquisition.value_or("optimised"));
  options.points = arguments.points.value_or(options.points);
  options.cutoff = cutoff;
  auto acquired = acquire_texture(std::move(scan->points), *texture, options, progress);
  if (!acquired) {
    return make_error("{} with {}: {}", mesh.string(), arguments.file.string(),
                      acquired.error().message);
  }
  note(describe(*acquired));
  SplatCloud cloud;
  cloud.radii.assign(acquired->splats.positions.size(), acquired->splats.deviation);
  cloud.colours.reserve(acquired->splats.colours.size());
  for (const glm::vec3 colour : acquired->splats.colours) cloud.colours.emplace_back(colour, 1.0F);
  cloud.positions = std::move(acquired->splats.positions);
  cloud.normals = std::move(acquired->splats.normals);
  return cloud;
}

}  // namespace relief::cli
