#include "renderer/volume/options.h"

#include "renderer/engine_options.h"

namespace relief {
namespace {

EngineOption transfer_option() {
  OptionRow row{.key = "transfer",
                .kind = OptionKind::Text,
                .placeholder = "NAME",
                .help =
                    "colour and opacity of a volume's values: auto, ct-bone, ct-skin, mr, none, "
                    "or a .json file",
                .default_text = "auto",
                .file_extension = ".json",
                .is_of_model = true};
  return {std::move(row),
          [](RenderSettings& settings, const OptionValue& value) {
            settings.volume.transfer = std::get<std::string>(value);
          },
          [](const RenderSettings& settings) {
            return std::optional<OptionValue>(settings.volume.transfer);
          }};
}

EngineOption clip_option() {
  OptionRow row{
      .key = "clip",
      .kind = OptionKind::Text,
      .placeholder = "X0,Y0,Z0,X1,Y1,Z1",
      .help =
          "draws only what lies in this box of world coordinates, or percentages of "
          "the model's extent as in 50%",
      .default_text = "",
      .accepts_text = [](std::string_view text) { return parse_clip_box(text).has_value(); },
      .expected_text = std::string(kClipBoxForm)};
  return {std::move(row),
          [](RenderSettings& settings, const OptionValue& value) {
            settings.volume.clip = parse_clip_box(std::get<std::string>(value));
          },
          [](const RenderSettings& settings) -> std::optional<OptionValue> {
            if (!settings.volume.clip) return std::nullopt;
            return text_of(*settings.volume.clip);
          }};
}

/// The options of volumes.
void add_volumes(std::vector<EngineOption>& options) {
  options.push_back(transfer_option());
  options.push_back(optional_number_option(
      {.key = "iso",
       .range = {-1e30, 1e30},
       .placeholder = "V",
       .help = "also draws the surface where the volume has this value",
       .default_text = "",
       .is_of_model = true},
      [](RenderSettings & s) -> auto& { return s.volume.iso; }));
  options.push_back(
      number_option({.key = "iso-opacity",
                     .range = kShares,
                     .placeholder = "A",
                     .help = "opacity of the surface that --iso draws, seen from the front",
                     .default_text = "0.9",
                     .is_of_model = true},
                    [](RenderSettings& s) -> double& { return s.volume.iso_opacity; }));
  options.push_back(
      number_option({.key = "kernel-sigma",
                     .range = kKernelSigmas,
                     .placeholder = "S",
                     .help = "standard deviation of a volume's kernels, in spacings",
                     .default_text = "1",
                     .is_of_model = true},
                    [](RenderSettings& s) -> double& { return s.volume.kernel_sigma; }));
  options.push_back(
      choice_option({.key = "attenuation",
                     .help = "opacity of an optical depth: itself, at most 1, or 1 - exp(-depth)",
                     .default_text = "linear"},
                    kAttenuations, {Attenuation::Linear, Attenuation::Exponential},
                    [](RenderSettings& s) -> Attenuation& { return s.volume.attenuation; }));
}

/// The options of 3D Gaussians.
void add_gaussians(std::vector<EngineOption>& options) {
  const auto share = [&](std::string key, std::string help, std::string usual,
                         double GaussianSettings::*member) {
    options.push_back(number_option(
        {.key = std::move(key),
         .range = kShares,
         .placeholder = "A",
         .help = std::move(help),
         .default_text = std::move(usual)},
        [member](RenderSettings& s) -> double& { return s.volume.gaussians.*member; }));
  };
  share("max-alpha", "largest opacity of a 3D Gaussian in a pixel", "0.99",
        &GaussianSettings::max_alpha);
  share("min-alpha", "fainter contributions of 3D Gaussians are left out", "1/255",
        &GaussianSettings::min_alpha);
  share("min-transmittance", "what is behind 3D Gaussians that let less through is left out",
        "0.0001", &GaussianSettings::min_transmittance);
  options.push_back(
      number_option({.key = "gaussian-near",
                     .range = {0.0, 1e12},
                     .placeholder = "D",
                     .help = "3D Gaussians nearer to the eye are left out, in world units",
                     .default_text = "0.2"},
                    [](RenderSettings& s) -> double& { return s.volume.gaussians.near; }));
  options.push_back(number_option(
      {.key = "jacobian-clamp",
       .range = {0.0, 100.0},
       .placeholder = "F",
       .help = "3D Gaussians farther from the axis than F times the image's edge are projected as "
               "there; 0: as where they are",
       .default_text = "1.3"},
      [](RenderSettings& s) -> double& { return s.volume.gaussians.jacobian_clamp; }));
  options.push_back(
      number_option({.key = "harmonics",
                     .range = {0.0, double{GaussianSettings::kMaxDegree}},
                     .placeholder = "N",
                     .help = "degree of the spherical harmonics that colour 3D Gaussians",
                     .default_text = "that of the file",
                     .is_of_model = true},
                    [](RenderSettings& s) -> int& { return s.volume.gaussians.degree; }));
  options.push_back(choice_option(
      {.key = "blend", .help = "colours in which 3D Gaussians are blended", .default_text = "srgb"},
      kGaussianBlends, {GaussianBlend::Srgb, GaussianBlend::Linear},
      [](RenderSettings& s) -> GaussianBlend& { return s.volume.gaussians.blend; }));
}

}  // namespace

std::vector<EngineOption> volume_options() {
  std::vector<EngineOption> options;
  options.push_back(
      choice_option({.key = "filter",
                     .help = "what keeps kernels from being smaller than pixels",
                     .default_text = "ewa; dilated for 3D Gaussians"},
                    kVolumeFilters,
                    {VolumeFilter::Automatic, VolumeFilter::Ewa, VolumeFilter::UniformScaling,
                     VolumeFilter::Unfiltered, VolumeFilter::Dilated},
                    [](RenderSettings& s) -> VolumeFilter& { return s.volume.filter; }));
  options.push_back(
      choice_option({.key = "visibility",
                     .help = "the order in which kernels occlude one another",
                     .default_text = "sheet for grids, sorted for others"},
                    kVolumeVisibilities,
                    {VolumeVisibility::Automatic, VolumeVisibility::Sheet,
                     VolumeVisibility::ImageSheet, VolumeVisibility::Sorted},
                    [](RenderSettings& s) -> VolumeVisibility& { return s.volume.visibility; }));
  options.push_back(
      number_option({.key = "cutoff",
                     .range = kCutoffs,
                     .placeholder = "C",
                     .help = "where kernels end, as x^T Q x",
                     .default_text = "4; of 3D Gaussians where they are fainter than --min-alpha"},
                    [](RenderSettings& s) -> double& { return s.volume.cutoff; }));
  options.push_back(clip_option());
  add_volumes(options);
  add_gaussians(options);
  return options;
}

EngineOption coarse_option() {
  return number_option(
      {.key = "pixels-per-node",
       .range = kPixelsPerNode,
       .placeholder = "P",
       .help =
           "draws a regular grid as coarsely as its nodes are seen at most so many pixels apart; "
           "0: as it is",
       .default_text = "0"},
      [](RenderSettings& settings) -> double& { return settings.volume.pixels_per_node; });
}

}  // namespace relief
