#include "cli/options/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "cli/options/values.h"
#include "common/io/extension.h"
#include "renderer/engine_registry.h"

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
void add_number(CLI::App& sub, const std::string& name, std::optional<T>& to, NumberChoice range,
                const std::string& letter, const std::string& description) {
  sub.add_option(name, to, description)
      ->check([range](const std::string& text) {
        const std::optional<double> value = parse_number(text);
        const bool good = value && *value >= range.least && *value <= range.most;
        return good ? std::string()
                    : fmt::format("expected a number from {:g} to {:g}; found {}", range.least,
                                  range.most, text);
      })
      ->option_text(letter);
}

void add_way_options(CLI::App& sub, SceneSettings& settings) {
  std::vector<std::string> names;
  for (const EngineEntry& engine : engines()) names.push_back(engine.name);
  sub.add_option(
         "--engine", settings.engine,
         "onepass draws patches in one pass, multipass in three (splats with deferred shading); "
         "ewa "
         "splats points on the CPU, those of a scan or the samples of "
         "patches; raytrace follows rays to a mesh's triangles or those of patches (onepass)")
      ->check([names](const std::string& text) {
        return find_engine(text) != nullptr
                   ? std::string()
                   : fmt::format("expected {}; found {}", fmt::join(names, ", "), text);
      })
      ->option_text(fmt::format("{}", fmt::join(names, "|")));
  add_choice(sub, "--primitive", settings.primitive, kPrimitives,
             "What is rasterised: a sprite or a quad for each sample, or the cells between them, "
             "which is for "
             "onepass (cell; quad with multipass)");
  add_choice(sub, "--interpolation", settings.interpolation, kInterpolations,
             "How a fragment finds its place on the patch: direct is faster, corrected more "
             "exact (corrected)");
  add_cull_option(sub, settings);
}

void add_image_options(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::string>(
         "--background", [&](const std::string& s) { settings.background = parse_background(s); },
         "sRGB values from 0 to 1, or none: transparent (0,0,0)")
      ->option_text("R,G,B|none");
  sub.add_option_function<std::string>(
         "--outputs", [&](const std::string& s) { settings.outputs = parse_outputs(s); },
         "What an .exr holds: all, colour, or some of normal,depth,uv,patch beside the colour "
         "(all)")
      ->option_text("LIST");
}

void add_engine_options(CLI::App& sub, SceneSettings& settings) {
  add_number(sub, "--pixels-per-sample", settings.pixels_per_sample, kPixelsPerSample, "P",
             "onepass: draws coarser levels of patches where samples are then seen at "
             "most P pixels apart; 0 is always the finest (4 with cells, else 0)");
  add_number(sub, "--radius-factor", settings.radius_factor, kRadiusFactors, "F",
             "multipass: radius of its splats, over that of onepass's sprites (2)");
  add_number(sub, "--samples", settings.samples, kSampleCounts, "N",
             "onepass, multipass: samples a pixel, in a square grid of at least so many; raytrace: "
             "rays a pixel; 1 is not antialiased (1; raytrace 16)");
  add_choice(sub, "--filter", settings.filter, kFilters,
             "ewa: the resampling filter; all but ewa are for comparison (ewa)");
  add_number(sub, "--cutoff", settings.cutoff, kCutoffs, "C",
             "ewa: where kernels end, as an exponent; larger is better and slower (1)");
  add_number(sub, "--layers", settings.layers, kLayerCounts, "L",
             "ewa: surfaces behind one another that a pixel keeps apart (4)");
  add_number(sub, "--tau", settings.coverage_threshold, kCoverageThresholds, "T",
             "ewa: sum of kernels from which on a pixel is covered (0.4)");
  add_number(sub, "--time-budget", settings.time_budget_ms, kTimeBudgets, "MS",
             "ewa: draw coarser sets of points first, and finer ones while this time lasts");
}

/// Nor an option of one material to another.
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

/// An option of one engine says nothing to another. A scene's views may have several engines.
void check_engine_options(const RenderArguments& arguments) {
  const SceneSettings& settings = arguments.settings;
  const std::string engine = settings.engine.value_or("onepass");
  const std::string kind = lower_extension(arguments.input);
  if (!arguments.texture.file.empty() && (kind == ".json" || kind == ".relief"))
    throw CLI::ValidationError("--texture", "needs a mesh");
  if (engine != "ewa" && (arguments.texture.acquisition || arguments.texture.points))
    throw CLI::ValidationError("--acquisition, --points", "are for --engine ewa");
  if (kind == ".json") return;
  if (settings.pixels_per_sample && engine != "onepass")
    throw CLI::ValidationError("--pixels-per-sample", "is for --engine onepass");
  if (settings.radius_factor && engine != "multipass")
    throw CLI::ValidationError("--radius-factor", "is for --engine multipass");
  if (settings.cull && !needs_opengl(engine))
    throw CLI::ValidationError("--cull", "is for --engine onepass and multipass");
  if (settings.primitive == Primitive::Cell && engine == "multipass")
    throw CLI::ValidationError("--primitive", "cell is for --engine onepass");
  if (settings.samples && engine == "ewa")
    throw CLI::ValidationError("--samples", "is not for --engine ewa, which filters instead");
  if (arguments.explain && !needs_opengl(engine))
    throw CLI::ValidationError("--explain", "is for --engine onepass");
  const bool for_ewa = settings.filter || settings.cutoff || settings.layers ||
                       settings.coverage_threshold || settings.time_budget_ms;
  if (for_ewa && engine != "ewa") {
    throw CLI::ValidationError("--filter, --cutoff, --layers, --tau, --time-budget",
                               "are for --engine ewa");
  }
}

}  // namespace

void add_camera_options(CLI::App& sub, SceneSettings& settings) {
  sub.add_option_function<std::string>(
         "--size", [&](const std::string& s) { settings.size = parse_size(s); },
         "Picture size in pixels (1280x1024)")
      ->option_text("WxH");
  auto* const orbit =
      sub.add_option_function<std::string>(
             "--orbit", [&](const std::string& s) { settings.orbit = parse_orbit(s); },
             "Camera on an orbit: azimuth (0 is +Z, turning to +X) and elevation in degrees, "
             "distance in bounding-sphere radii (0,0 and the whole model in view)")
          ->option_text("AZ,EL[,DIST]");
  auto* const eye = sub.add_option_function<std::string>(
                           "--eye", [&](const std::string& s) { settings.eye = parse_vector(s); },
                           "Camera at a place instead, in the model's coordinates")
                        ->option_text("X,Y,Z")
                        ->excludes(orbit);
  sub.add_option_function<std::string>(
         "--target", [&](const std::string& s) { settings.target = parse_vector(s); },
         "What --eye looks at (the middle of the model)")
      ->option_text("X,Y,Z")
      ->needs(eye);
  sub.add_option_function<std::string>(
         "--up", [&](const std::string& s) { settings.up = parse_vector(s); },
         "What is up for --eye (0,1,0)")
      ->option_text("X,Y,Z")
      ->needs(eye);
  add_number(sub, "--fov", settings.fov_degrees, {kMinFieldOfView, kMaxFieldOfView}, "DEG",
             "Vertical field of view in degrees (45)");
  sub.add_option_function<std::string>(
         "--orthographic",
         [&](const std::string& s) { settings.orthographic = parse_orthographic(s); },
         "Parallel rays instead: the picture's height in the model's coordinates, or fit: the "
         "whole model. What is behind the plane through the eye is not seen")
      ->option_text("HEIGHT|fit")
      ->excludes("--fov");
}

void add_cull_option(CLI::App& sub, SceneSettings& settings) {
  add_choice(
      sub, "--cull", settings.cull, kCullModes,
      "onepass, multipass: which faces are not drawn. none: draws both sides; back: leaves out "
      "faces that "
      "look away from the eye; auto: back for models known to be closed, seen from outside (none)");
}

void add_material_options(CLI::App& sub, SceneSettings& settings) {
  add_choice(
      sub, "--material", settings.material, kMaterials,
      "unlit is the stored colour and nothing else; mirror reflects --env, glass refracts it "
      "too; split shows quarters that are lit, mirror, both and the samples (lit)");
  add_number(sub, "--ior", settings.ior, kRefractiveIndices, "N",
             "glass: its index of refraction (1.5)");
  sub.add_option_function<std::string>(
         "--absorption", [&](const std::string& s) { settings.absorption = parse_absorption(s); },
         "glass: what it takes of red, green and blue along the body's diameter, as exponents "
         "(0,0,0)")
      ->option_text("R,G,B");
  add_number(sub, "--interfaces", settings.interfaces, kInterfaceCounts, "1|2",
             "glass: refracts where light enters, or where it leaves too; 2 is for onepass with "
             "cells and for raytrace (1)");
  add_number(sub, "--roughness", settings.roughness, kRoughnesses, "R",
             "mirror, split: from 0, smooth, to 1 (0)");
  add_number(sub, "--opacity", settings.opacity, kOpacities, "A",
             "How much of what is behind a surface it covers, from 0 to 1 (1)");
  add_number(sub, "--exposure", settings.exposure, kExposures, "STOPS",
             "A PNG's light is multiplied by 2 to this power; an EXR's never is (0)");
  sub.add_option("--env", settings.environment,
                 "Environment map, EXR or HDR: equirectangular, a cross of six faces, or six files "
                 "such as sky_{face}.hdr with px nx py ny pz nz for {face} (built in: a colour for "
                 "each direction, with a grid)")
      ->option_text("FILE");
}

void add_platform_option(CLI::App& sub, GlPlatform& platform) {
  sub.add_option_function<std::string>(
         "--gl", [&](const std::string& s) { platform = kPlatforms.at(s); },
         "Where OpenGL comes from; auto tries EGL, then OSMesa (auto)")
      ->check(CLI::IsMember(kPlatforms))
      ->option_text("auto|egl|osmesa");
}

void add_render_options(CLI::App& sub, RenderArguments& arguments) {
  sub.add_option("SCENE", arguments.input, "A .relief file, a scan, a mesh or a .json scene")
      ->required()
      ->option_text("FILE");
  sub.add_option("-o,--output", arguments.output,
                 "The picture to write: .png or .exr; {view} in it stands for the name of a "
                 "scene's view")
      ->required()
      ->option_text("FILE (required)");
  add_camera_options(sub, arguments.settings);
  add_way_options(sub, arguments.settings);
  add_material_options(sub, arguments.settings);
  add_image_options(sub, arguments.settings);
  add_engine_options(sub, arguments.settings);
  add_texture_options(sub, arguments.texture);
  sub.add_option(
         "--frames", arguments.frames,
         "Time N frames, on OpenGL after a first one, report the median, and count fragments "
         "(by default the image is drawn once)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  add_platform_option(sub, arguments.platform);
  sub.add_flag("--explain", arguments.explain,
               "onepass, multipass: also tell what the picture took: features, shader variants, "
               "buffers, textures, passes and draws");
  sub.add_flag("--json", arguments.json, "Print one JSON object on standard output");
}

void check_camera(const SceneSettings& settings) {
  if (settings.eye && settings.eye == settings.target) {
    throw CLI::ValidationError("--target", "must not be where --eye is");
  }
  if (settings.up == glm::dvec3(0.0)) {
    throw CLI::ValidationError("--up", "must not be 0,0,0");
  }
}

void check_together(const RenderArguments& arguments) {
  const std::string format = lower_extension(arguments.output);
  if (format != ".png" && format != ".exr") {
    throw CLI::ValidationError("--output", "expected a name that ends in .png or .exr");
  }
  const SceneSettings& settings = arguments.settings;
  const Outputs outputs = settings.outputs.value_or(Outputs{});
  if (format == ".png" && (outputs.normal || outputs.depth || outputs.uv || outputs.patch_id)) {
    throw CLI::ValidationError("--outputs", "a PNG holds colour alone; write an .exr");
  }
  check_material_options(arguments);
  check_engine_options(arguments);
  check_camera(settings);
}

}  // namespace relief::cli
