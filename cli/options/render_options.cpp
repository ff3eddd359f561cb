#include "cli/options/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>

#include "cli/options/engine_options.h"
#include "cli/options/read_options.h"
#include "cli/options/values.h"
#include "common/image/film_file.h"
#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "common/scene/views/camera_path.h"
#include "loader/scene/view_settings.h"
#include "renderer/costs/feature_costs.h"

namespace relief::cli {
namespace {

const std::map<std::string, GlPlatform> kPlatforms{
    {"auto", GlPlatform::Automatic}, {"egl", GlPlatform::Egl}, {"osmesa", GlPlatform::Osmesa}};

/// An option whose values have names.
template <class T, std::size_t N>
CLI::Option* add_choice(CLI::App& sub, const std::string& name, std::optional<T>& to,
                        const std::array<Named<T>, N>& table, const std::string& description) {
  return sub
      .add_option_function<std::string>(
          name, [&to, &table](const std::string& text) { to = find_named(table, text); },
          description)
      ->check([&table](const std::string& text) {
        return find_named(table, text) ? std::string()
                                       : "expected " + list_names(table, ", ") + "; found " + text;
      })
      ->option_text(list_names(table, "|"));
}

/// A number from a range.
template <class T>
CLI::Option* add_number(CLI::App& sub, const std::string& name, std::optional<T>& to,
                        NumberChoice range, const std::string& letter,
                        const std::string& description) {
  return sub.add_option(name, to, description)
      ->check([range](const std::string& text) {
        const std::optional<double> value = parse_number(text);
        const bool good = value && *value >= range.min && *value <= range.max;
        return good ? std::string()
                    : fmt::format("expected a number from {:g} to {:g}; found {}", range.min,
                                  range.max, text);
      })
      ->option_text(letter);
}

void add_light_options(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::vector<std::string>>(
         "--light",
         [&](const std::vector<std::string>& texts) {
           auto& lights = settings.lights.emplace();
           for (const std::string& text : texts) lights.push_back(parse_light(text));
           if (lights.size() > kMaxLights) {
             throw CLI::ValidationError(
                 "--light", fmt::format("is there {} times; an image has at most {} lights",
                                        lights.size(), kMaxLights));
           }
         },
         "Light on lit models, once for each, up to 16: the direction toward it, or point: and its "
         "position, then its linear colour (default: three lights fixed to the camera, "
         "on terrain a sun in the west-north-west; white)")
      ->take_all()
      ->allow_extra_args(false)
      ->option_text("[point:]X,Y,Z[,R,G,B]");
  sub.add_option_function<std::string>(
         "--ambient", [&](const std::string& s) { settings.ambient = parse_ambient(s); },
         "Light on lit models from all directions, linear, each 0 to 1000 (default "
         "0.06,0.06,0.06; 0.045,0.05,0.06 on terrain; 0,0,0 with --env)")
      ->option_text("R,G,B");
}

void add_outputs_option(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::string>(
         "--outputs", [&](const std::string& s) { settings.outputs = parse_outputs(s); },
         "Outputs that an .exr holds beside colour: all, colour for none, or some of "
         "normal,depth,uv,patch, and of engines that clip splats clip (default all, which "
         "leaves that out)")
      ->option_text("LIST");
}

/// Options of some materials need one of them. A scene's models may have several materials.
void check_material_options(const RenderArguments& arguments) {
  const SceneSettings& settings = arguments.settings;
  if (settings.exposure && lower_extension(arguments.output) == ".exr")
    throw CLI::ValidationError("--exposure", "is for a .png; an EXR keeps the light as it is");
  if (lower_extension(arguments.input) == ".json") return;
  const Material material = settings.material.value_or(Material::Lit);
  if ((settings.ior || settings.absorption || settings.interfaces) && material != Material::Glass)
    throw CLI::ValidationError("--ior, --absorption, --interfaces", "are for --material glass");
  if (settings.roughness && material != Material::Mirror && material != Material::Split)
    throw CLI::ValidationError("--roughness", "is for --material mirror and split");
}

/// Options of some engines need one of them. A scene's views may have several engines.
void check_for_engine(const RenderArguments& arguments) {
  const std::string kind = lower_extension(arguments.input);
  const TextureArguments& texture = arguments.texture;
  if (!texture.file.empty() && (kind == ".json" || kind == ".relief"))
    throw CLI::ValidationError("--texture", "needs a mesh");
  if (arguments.colours.scalar && kind == ".json")
    throw CLI::ValidationError("--colour-by", "is for a scan, mesh or patch file, not for a scene");
  if (arguments.colours.scalar && !texture.file.empty())
    throw CLI::ValidationError("--colour-by", "excludes --texture");
  const PlannedView view{"", arguments.settings, {}};
  const EngineEntry& engine = **engine_of(view);
  if ((texture.acquisition || texture.points) && engine.forms.front() != ModelForm::Splats)
    throw CLI::ValidationError("--acquisition, --points",
                               "are for an engine that draws splats, as ewa does");
  if (kind == ".json") return;
  check_engine_options(arguments.settings);
  if (arguments.explain && !engine.capabilities.explanation)
    throw CLI::ValidationError("--explain", fmt::format("engine {} has none", engine.name));
  if (arguments.time_passes && !engine.capabilities.explanation)
    throw CLI::ValidationError("--time-passes", fmt::format("engine {} has none", engine.name));
  if (arguments.explain_cost && !can_measure_costs(engine)) {
    throw CLI::ValidationError(
        "--explain-cost",
        fmt::format("is for engines that draw patches with OpenGL; {} does not", engine.name));
  }
}

}  // namespace

void add_background_options(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::string>(
         "--background", [&](const std::string& s) { settings.background = parse_background(s); },
         "Background colour, sRGB, each 0 to 1; none: transparent (default: the environment of "
         "--env, "
         "otherwise grey)")
      ->option_text("R,G,B|none");
  add_number(sub, "--edl", settings.eye_dome, kEyeDomes, "S",
             "Eye-dome lighting of this strength, 0 to 100: what lies behind its neighbours is "
             "darker; 1 is usual (default 0)");
}

void add_camera_options(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::string>(
         "--size", [&](const std::string& s) { settings.size = parse_size(s); },
         "Image size in pixels, each 1 to 32768 (default 1280x1024)")
      ->option_text("WxH");
  auto* const orbit =
      sub.add_option_function<std::string>(
             "--orbit", [&](const std::string& s) { settings.orbit = parse_orbit(s); },
             "Camera on an orbit about the model: azimuth (0 is in front, 90 to the right) and "
             "elevation in degrees, distance in bounding-sphere radii (default: obliquely from the "
             "front, from where the model fills the image)")
          ->option_text("AZ,EL[,DIST]");
  auto* const view = sub.add_option_function<std::string>(
                            "--view", [&](const std::string& s) { settings.orbit = parse_view(s); },
                            "The same by name (default: as --orbit has it)")
                         ->option_text(list_names(kViews, "|"))
                         ->excludes(orbit);
  auto* const eye = sub.add_option_function<std::string>(
                           "--eye", [&](const std::string& s) { settings.eye = parse_vector(s); },
                           "Camera position in the model's coordinates (default: on the orbit)")
                        ->option_text("X,Y,Z")
                        ->excludes(orbit)
                        ->excludes(view);
  sub.add_option_function<std::string>(
         "--target", [&](const std::string& s) { settings.target = parse_vector(s); },
         "Point that --eye looks at, in the model's coordinates (default: the middle of the model)")
      ->option_text("X,Y,Z")
      ->needs(eye);
  sub.add_option_function<std::string>(
         "--up", [&](const std::string& s) { settings.up = parse_up(s); },
         "Up direction of the model, for --orbit and --view, and of --eye (default: z for points, "
         "y for meshes, and as the sensor stood for PCD)")
      ->option_text("x|y|z|-x|-y|-z|X,Y,Z");
  add_number(sub, "--roll", settings.roll_degrees, {-360.0, 360.0}, "DEG",
             "Turn the camera about its line of sight, counter-clockwise, in degrees, -360 to 360 "
             "(default 0)");
  add_number(sub, "--zoom", settings.zoom, kZooms, "N",
             "Show the middle of the image so many times as large, 0.01 to 10000 (default 1)");
  add_number(sub, "--fov", settings.fov_degrees, {kMinFieldOfView, kMaxFieldOfView}, "DEG",
             "Vertical field of view in degrees, 0.01 to 175 (default 45)");
  sub.add_option_function<std::string>(
         "--orthographic",
         [&](const std::string& s) { settings.orthographic = parse_orthographic(s); },
         "Orthographic camera: height of the image in the model's coordinates, above 0, or fit for "
         "the whole model; nothing behind the plane through the eye is seen (default: perspective)")
      ->option_text("HEIGHT|fit")
      ->excludes("--fov");
}

void add_material_options(CLI::App& sub, SceneSettings& settings) {
  add_choice(
      sub, "--material", settings.material, kMaterials,
      "Material: unlit shows the stored colour; lit shades it; mirror reflects --env; glass "
      "refracts it, too; split shows quarters: lit, mirror, both, the samples (default: unlit for "
      "points with colours, lit for others)");
  add_number(sub, "--ior", settings.ior, kRefractiveIndices, "N",
             "glass: index of refraction, 1 to 4 (default 1.5)");
  sub.add_option_function<std::string>(
         "--absorption", [&](const std::string& s) { settings.absorption = parse_absorption(s); },
         "glass: absorption of red, green and blue along the body's diameter, as exponents, 0 to "
         "100 (default 0,0,0)")
      ->option_text("R,G,B");
  add_number(
      sub, "--interfaces", settings.interfaces, kInterfaceCounts, "1|2",
      "glass: surfaces that refract: 1, where light enters, or 2, also where it leaves; 2 is "
      "for onepass with cells and for raytrace (default 1)");
  add_number(sub, "--roughness", settings.roughness, kRoughnesses, "R",
             "mirror, split: roughness, 0 is smooth, to 1 (default 0)");
  add_number(sub, "--opacity", settings.opacity, kOpacities, "A",
             "Opacity of the surface, 0 to 1 (default 1)");
  add_number(sub, "--exposure", settings.exposure, kExposures, "STOPS",
             "Exposure of a .png in stops, -20 to 20: light is multiplied by 2 to this power "
             "(default 0)");
  sub.add_option(
         "--env", settings.environment,
         "Environment map that is reflected, gives the light of lit models and is seen behind "
         "them, EXR or HDR: equirectangular, a cross of six faces, or six files "
         "such as sky_{face}.hdr with px nx py ny pz nz for {face} (default: a built-in map, "
         "one colour for each direction, with a grid)")
      ->option_text("FILE");
  add_number(sub, "--env-rotation", settings.environment_rotation_degrees, {-360.0, 360.0}, "DEG",
             "Turn the environment about the model's up direction, counter-clockwise as seen from "
             "above, in degrees, -360 to 360 (default 0: its middle is behind the model)");
}

void add_platform_option(CLI::App& sub, GlPlatform& platform) {
  sub.add_option_function<std::string>(
         "--gl", [&](const std::string& s) { platform = kPlatforms.at(s); },
         "OpenGL platform; auto tries EGL, then OSMesa (default auto)")
      ->check(CLI::IsMember(kPlatforms))
      ->option_text("auto|egl|osmesa");
}

void add_render_options(CLI::App& sub, RenderArguments& arguments) {
  sub.add_option("SCENE", arguments.input,
                 "Patch file (.relief), scan, mesh, raster, or .json scene; -: standard input")
      ->required()
      ->option_text("FILE");
  sub.add_option(
         "-o,--output", arguments.output,
         "Image to write, .png or .exr, or film, .mp4 or .webm; {view} in it stands for the "
         "name of each view of a scene; -: a PNG to standard output")
      ->required()
      ->option_text("FILE (required)");
  add_camera_options(sub, arguments.settings);
  add_quality_option(sub, arguments.quality);
  add_engine_options(sub, arguments.settings);
  add_material_options(sub, arguments.settings);
  add_colour_options(sub, arguments.colours);
  add_light_options(sub, arguments.settings);
  add_background_options(sub, arguments.settings);
  add_outputs_option(sub, arguments.settings);
  add_texture_options(sub, arguments.texture);
  CLI::Option* const turntable =
      sub.add_option("--turntable", arguments.turntable,
                     "Make a film of so many frames, 2 to 100000, in which the camera goes once "
                     "around the model: a .mp4 or .webm, by ffmpeg, or numbered images (default: "
                     "one image)")
          ->check(CLI::Range(2, 100000))
          ->option_text("N");
  sub.add_option(
         "--path", arguments.path,
         "Make a film in which the camera follows a path, a .json file of cameras and "
         "times: as many frames as its seconds times --fps, written as those of --turntable "
         "(default: one image)")
      ->option_text("FILE")
      ->excludes(turntable);
  add_number(
      sub, "--fps", arguments.frames_per_second, kFrameRates, "N",
      "Frames per second of a film, 1 to 240 (default: what the file of --path says, or 30)");
  add_read_options(sub, arguments.read);
  add_raw_option(sub, arguments.volume);
  add_volume_scalar_option(sub, arguments.volume);
  sub.add_option(
         "--frames", arguments.frames,
         "Frames to time after the one that draws the image, 1 to 100000; reports the median, "
         "and counts fragments (default: none)")
      ->check(count_from(1, 100000))
      ->option_text("N");
  add_platform_option(sub, arguments.platform);
  sub.add_flag(
      "--explain", arguments.explain,
      "Engines with OpenGL: report features, shader variants, buffers, textures, passes and "
      "draws of the image, and what was read of patch files");
  sub.add_flag("--time-passes", arguments.time_passes,
               "Engines with OpenGL: draw the image again, 5 times or --frames times, and report "
               "the median time of each pass");
  sub.add_flag_function(
      "--explain-cost",
      [&](std::int64_t /*count*/) { arguments.explain = arguments.explain_cost = true; },
      "onepass, multipass: also draw the image without each of its features, 9 times each in turns "
      "with the whole image, or --frames times; report what each costs: bytes, passes, lines of "
      "shaders, milliseconds");
  sub.add_flag("--json", arguments.json, "Print one JSON object on standard output");
}

void check_camera(const SceneSettings& settings) {
  if (settings.eye && settings.eye == settings.target) {
    throw CLI::ValidationError("--target", "must not equal --eye");
  }
}

namespace {

/// A camera path takes the place of all cameras.
void check_path(const RenderArguments& arguments) {
  if (arguments.output == kStandardName)
    throw CLI::ValidationError("--path", "makes more than one image; name a file to write");
  const SceneSettings& settings = arguments.settings;
  if (settings.orbit || settings.eye || settings.up || settings.fov_degrees ||
      settings.orthographic) {
    throw CLI::ValidationError(
        "--path", "has cameras; leave out --orbit, --view, --eye, --up, --fov and --orthographic");
  }
}

}  // namespace

void check_together(const RenderArguments& arguments) {
  const std::string format =
      arguments.output == kStandardName ? ".png" : lower_extension(arguments.output);
  const bool is_film = is_film_name(arguments.output);
  if (format != ".png" && format != ".exr" && !is_film) {
    throw CLI::ValidationError(
        "--output",
        "expected a name that ends in .png or .exr, or .mp4 or .webm for a film; found " +
            arguments.output.string());
  }
  const bool has_frames = arguments.turntable > 0 || !arguments.path.empty();
  if (is_film && !has_frames) {
    throw CLI::ValidationError(
        "--output", "a film needs --turntable N, the number of its frames, or --path FILE");
  }
  if (arguments.frames_per_second && !has_frames)
    throw CLI::ValidationError("--fps", "is for a film: --turntable or --path");
  if (!arguments.path.empty()) check_path(arguments);
  if (arguments.turntable > 0 && arguments.output == kStandardName)
    throw CLI::ValidationError("--turntable", "makes more than one image; name a file to write");
  if (arguments.turntable > 0 && arguments.settings.eye) {
    throw CLI::ValidationError("--turntable",
                               "goes around the model on --orbit or --view, not at --eye");
  }
  const SceneSettings& settings = arguments.settings;
  const Outputs outputs = settings.outputs.value_or(Outputs{});
  if (format != ".exr" && has_any(outputs)) {
    throw CLI::ValidationError("--outputs", "only an .exr holds more than colour");
  }
  check_material_options(arguments);
  check_for_engine(arguments);
  check_camera(settings);
}

}  // namespace relief::cli
