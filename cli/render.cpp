// relief render: a patch file or a scan becomes a picture.
#include "renderer/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "cli/acquire.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/load.h"
#include "cli/paths.h"
#include "cli/values.h"
#include "common/camera.h"
#include "common/image_io.h"

namespace relief::cli {
namespace {

constexpr const char* kExamples =
    "In brackets: what is taken where an option is not given.\n"
    "SCENE is a .relief file, or a scan or mesh that is converted in memory with the default\n"
    "options; --engine ewa draws its points as they are. The camera looks at the middle of the\n"
    "model unless --eye says otherwise.\n"
    "No display is needed.\n"
    "\n"
    "Examples:\n"
    "  relief render dragon.relief -o dragon.png --orbit 30,20\n"
    "  relief render dragon.relief -o dragon.png --material mirror --env studio.hdr\n"
    "  relief render statue.ply -o statue.exr --material unlit --background none --size 4096x4096\n"
    "  relief render dragon.relief -o top.png --eye 0,1,0 --target 0,0,0 --up 0,0,-1";

const std::map<std::string, EngineKind> kEngines{{"onepass", EngineKind::Onepass},
                                                 {"ewa", EngineKind::Ewa}};
const std::map<std::string, EwaFilter> kFilters{{"ewa", EwaFilter::Ewa},
                                                {"source-space", EwaFilter::SourceSpace},
                                                {"circular", EwaFilter::Circular},
                                                {"unfiltered", EwaFilter::Unfiltered}};
const std::map<std::string, Primitive> kPrimitives{{"sprite", Primitive::Sprite},
                                                   {"quad", Primitive::Quad}};
const std::map<std::string, Interpolation> kInterpolations{{"direct", Interpolation::Direct},
                                                           {"corrected", Interpolation::Corrected}};
const std::map<std::string, Material> kMaterials{
    {"unlit", Material::Unlit}, {"lit", Material::Lit}, {"mirror", Material::Mirror}};
const std::map<std::string, GlPlatform> kPlatforms{
    {"auto", GlPlatform::Automatic}, {"egl", GlPlatform::Egl}, {"osmesa", GlPlatform::Osmesa}};

struct Arguments {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::string engine = "onepass";
  std::string filter = "ewa";
  std::string primitive = "quad";
  std::string interpolation = "corrected";
  std::string material = "lit";
  std::string platform = "auto";
  std::optional<Outputs> outputs;
  Size size;
  Orbit orbit;
  std::optional<glm::dvec3> eye;
  std::optional<glm::dvec3> target;
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov_degrees = 45.0;
  TextureArguments texture;
  RenderSettings settings;  ///< environment, background and frames; the rest is filled in later
  bool json = false;
};

bool writes_exr(const Arguments& arguments) {
  return ending(arguments.output) == ".exr";
}

/// What the camera has to see.
struct Extent {
  Bounds bounds;
  double radius = 0.0;
};

Camera camera_for(const Extent& model, const Arguments& arguments) {
  const glm::dvec3 centre = 0.5 * (model.bounds.min + model.bounds.max);
  if (arguments.eye) {
    return {*arguments.eye, arguments.target.value_or(centre), arguments.up, arguments.fov_degrees};
  }
  return orbit_camera(centre, model.radius, arguments.orbit, arguments.fov_degrees,
                      static_cast<double>(arguments.size.width) / arguments.size.height);
}

RenderSettings settings_for(const Extent& model, const Arguments& arguments) {
  RenderSettings settings = arguments.settings;
  settings.width = arguments.size.width;
  settings.height = arguments.size.height;
  settings.camera = camera_for(model, arguments);
  settings.engine = kEngines.at(arguments.engine);
  settings.ewa.filter = kFilters.at(arguments.filter);
  settings.primitive = kPrimitives.at(arguments.primitive);
  settings.interpolation = kInterpolations.at(arguments.interpolation);
  settings.material = kMaterials.at(arguments.material);
  settings.platform = kPlatforms.at(arguments.platform);
  if (writes_exr(arguments))
    settings.outputs = arguments.outputs.value_or(Outputs{true, true, true, true});
  return settings;
}

template <class T>
nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json as_json(const RenderResult& result, const Arguments& arguments) {
  const bool patches = kEngines.at(arguments.engine) == EngineKind::Onepass;
  const auto of_patches = [patches](const std::string& way) {
    return patches ? nlohmann::ordered_json(way) : nlohmann::ordered_json(nullptr);
  };
  return {{"engine", arguments.engine},
          {"primitive", of_patches(arguments.primitive)},
          {"interpolation", of_patches(arguments.interpolation)},
          {"material", arguments.material},
          {"renderer", result.renderer},
          {"width", result.image.width},
          {"height", result.image.height},
          {"frame_ms", result.frame_ms},
          {"gpu_ms", value_or_null(result.gpu_ms)},
          {"covered_pixels", result.covered_pixels},
          {"fragments", value_or_null(result.fragments)},
          {"level", value_or_null(result.level)}};
}

std::string as_text(const RenderResult& result, const Arguments& arguments) {
  const std::string fragments =
      result.fragments ? fmt::format("{}", *result.fragments) : std::string("not counted");
  const std::string way = kEngines.at(arguments.engine) == EngineKind::Ewa
                              ? arguments.filter
                              : arguments.primitive + ", " + arguments.interpolation;
  return fmt::format(
      "{}\n"
      "  engine          {}, {}, {}\n"
      "  renderer        {}\n"
      "  size            {}x{}\n"
      "  frame           {:.2f} ms\n"
      "  covered pixels  {}\n"
      "  fragments       {}\n",
      arguments.output.string(), arguments.engine, way, arguments.material, result.renderer,
      result.image.width, result.image.height, result.frame_ms, result.covered_pixels, fragments);
}

/// Whether a scan's points are drawn, without conversion to patches.
bool splats_points(const Arguments& arguments) {
  return kEngines.at(arguments.engine) == EngineKind::Ewa && ending(arguments.scene) != ".relief";
}

Result<RenderResult> render_points(const Arguments& arguments, Progress& progress) {
  const auto cloud = arguments.texture.file.empty()
                         ? load_splats(arguments.scene, progress)
                         : acquire_splats(arguments.scene, arguments.texture,
                                          arguments.settings.ewa.cutoff, progress);
  if (!cloud) return cloud.error();
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("render", 0);
  const Bounds bounds = bounds_of(cloud->positions);
  const Extent extent{bounds, bounding_radius(cloud->positions, bounds)};
  return render(*cloud, settings_for(extent, arguments), progress);
}

Result<RenderResult> render_patches(const Arguments& arguments, Progress& progress) {
  const auto model = load_model(arguments.scene, progress);
  if (!model) return model.error();
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("render", 0);
  const Extent extent{model->bounds, model->bounding_radius};
  return render(*model, settings_for(extent, arguments), progress);
}

/// Loads, renders and writes.
Result<RenderResult> render_file(const Arguments& arguments) {
  ConsoleProgress progress;
  auto result = splats_points(arguments) ? render_points(arguments, progress)
                                         : render_patches(arguments, progress);
  if (!result) return result.error();
  if (progress.cancelled()) return interrupted_error();
  const Status written = writes_exr(arguments) ? write_exr(arguments.output, result->image)
                                               : write_png(arguments.output, result->image);
  if (!written) return written.error();
  return result;
}

int run(const Arguments& arguments) {
  const Status writable = check_output(
      arguments.output, {arguments.scene, arguments.settings.environment, arguments.texture.file});
  if (!writable) return fail(writable.error());
  // Known to be missing before a long conversion; what is wrong with it otherwise, render() tells.
  const std::filesystem::path& environment = arguments.settings.environment;
  std::error_code ignored;
  if (!environment.empty() && !std::filesystem::exists(environment, ignored)) {
    return fail(make_error("{}: there is no such file", environment.string()));
  }
  const auto result = render_file(arguments);
  if (!result) return fail(result.error());
  return arguments.json ? print_json(as_json(*result, arguments))
                        : print_result(as_text(*result, arguments));
}

/// CLI11's ranges let NaN pass.
void refuse_nan(const char* option, double value) {
  if (std::isnan(value)) throw CLI::ValidationError(option, "must be a number");
}

/// What no single option's check can see.
void check_together(const Arguments& arguments) {
  const std::string format = ending(arguments.output);
  if (format != ".png" && format != ".exr") {
    throw CLI::ValidationError("--output", "expected a name that ends in .png or .exr");
  }
  const Outputs outputs = arguments.outputs.value_or(Outputs{});
  if (format == ".png" && (outputs.normal || outputs.depth || outputs.uv || outputs.patch_id)) {
    throw CLI::ValidationError("--outputs", "a PNG holds colour alone; write an .exr");
  }
  if (!arguments.texture.file.empty() && !splats_points(arguments)) {
    throw CLI::ValidationError("--texture", "needs --engine ewa and a mesh");
  }
  if (arguments.eye && arguments.eye == arguments.target) {
    throw CLI::ValidationError("--target", "must not be where --eye is");
  }
  if (arguments.up == glm::dvec3(0.0)) {
    throw CLI::ValidationError("--up", "must not be 0,0,0");
  }
  refuse_nan("--fov", arguments.fov_degrees);
  refuse_nan("--cutoff", arguments.settings.ewa.cutoff);
  refuse_nan("--tau", arguments.settings.ewa.coverage_threshold);
  refuse_nan("--time-budget", arguments.settings.ewa.time_budget_ms);
}

void add_camera_options(CLI::App& sub, Arguments& arguments) {
  sub.add_option_function<std::string>(
         "--size", [&](const std::string& s) { arguments.size = parse_size(s); },
         "Picture size in pixels (1280x1024)")
      ->option_text("WxH");
  auto* const orbit =
      sub.add_option_function<std::string>(
             "--orbit", [&](const std::string& s) { arguments.orbit = parse_orbit(s); },
             "Camera on an orbit: azimuth (0 is +Z, turning to +X) and elevation in degrees, "
             "distance in bounding-sphere radii (0,0 and the whole model in view)")
          ->option_text("AZ,EL[,DIST]");
  auto* const eye = sub.add_option_function<std::string>(
                           "--eye", [&](const std::string& s) { arguments.eye = parse_vector(s); },
                           "Camera at a place instead, in the model's coordinates")
                        ->option_text("X,Y,Z")
                        ->excludes(orbit);
  sub.add_option_function<std::string>(
         "--target", [&](const std::string& s) { arguments.target = parse_vector(s); },
         "What --eye looks at (the middle of the model)")
      ->option_text("X,Y,Z")
      ->needs(eye);
  sub.add_option_function<std::string>(
         "--up", [&](const std::string& s) { arguments.up = parse_vector(s); },
         "What is up for --eye (0,1,0)")
      ->option_text("X,Y,Z")
      ->needs(eye);
  sub.add_option("--fov", arguments.fov_degrees, "Vertical field of view in degrees (45)")
      ->check(CLI::Range(0.1, 170.0))
      ->option_text("DEG");
}

void add_look_options(CLI::App& sub, Arguments& arguments) {
  sub.add_option(
         "--engine", arguments.engine,
         "What turns the model into pixels: onepass draws patches, ewa splats points on the "
         "CPU, those of a scan or the samples of a .relief file (onepass)")
      ->check(CLI::IsMember(kEngines))
      ->option_text("onepass|ewa");
  sub.add_option("--primitive", arguments.primitive, "What is rasterised for a sample (quad)")
      ->check(CLI::IsMember(kPrimitives))
      ->option_text("sprite|quad");
  sub.add_option("--interpolation", arguments.interpolation,
                 "How a fragment finds its place on the patch: direct is faster, corrected more "
                 "exact (corrected)")
      ->check(CLI::IsMember(kInterpolations))
      ->option_text("direct|corrected");
  sub.add_option("--material", arguments.material,
                 "unlit is the stored colour and nothing else; mirror reflects --env (lit)")
      ->check(CLI::IsMember(kMaterials))
      ->option_text("unlit|lit|mirror");
  sub.add_option("--env", arguments.settings.environment,
                 "Environment map, equirectangular EXR or HDR (built in: a colour for each "
                 "direction, with a grid)")
      ->option_text("FILE");
  sub.add_option_function<std::string>(
         "--background",
         [&](const std::string& s) { arguments.settings.background = parse_background(s); },
         "sRGB values from 0 to 1, or none: transparent (0,0,0)")
      ->option_text("R,G,B|none");
}

/// For --engine ewa.
void add_ewa_options(CLI::App& sub, Arguments& arguments) {
  EwaSettings& ewa = arguments.settings.ewa;
  sub.add_option("--filter", arguments.filter,
                 "ewa: the resampling filter; all but ewa are for comparison (ewa)")
      ->check(CLI::IsMember(kFilters))
      ->option_text("ewa|source-space|circular|unfiltered");
  sub.add_option("--cutoff", ewa.cutoff,
                 "ewa: where kernels end, as an exponent; larger is better and slower (1)")
      ->check(CLI::Range(0.1, 20.0))
      ->option_text("C");
  sub.add_option("--layers", ewa.layers,
                 "ewa: surfaces behind one another that a pixel keeps apart (4)")
      ->check(CLI::Range(1, 64))
      ->option_text("L");
  sub.add_option("--tau", ewa.coverage_threshold,
                 "ewa: sum of kernels from which on a pixel is covered (0.4)")
      ->check(CLI::Range(1e-6, 1.0))
      ->option_text("T");
  sub.add_option("--time-budget", ewa.time_budget_ms,
                 "ewa: draw coarser sets of points first, and finer ones while this time lasts")
      ->check(CLI::PositiveNumber)
      ->option_text("MS");
}

}  // namespace

void add_render(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("render", "Render a patch file or a scan to a picture");
  const auto arguments = std::make_shared<Arguments>();
  sub->add_option("SCENE", arguments->scene, "A .relief file, a scan or a mesh")
      ->required()
      ->option_text("FILE");
  sub->add_option("-o,--output", arguments->output, "The picture to write: .png or .exr")
      ->required()
      ->option_text("FILE (required)");
  add_camera_options(*sub, *arguments);
  add_look_options(*sub, *arguments);
  add_ewa_options(*sub, *arguments);
  add_texture_options(*sub, arguments->texture);
  sub->add_option_function<std::string>(
         "--outputs", [arguments](const std::string& s) { arguments->outputs = parse_outputs(s); },
         "What an .exr holds: all, colour, or some of normal,depth,uv,patch beside the colour "
         "(all)")
      ->option_text("LIST");
  sub->add_option("--frames", arguments->settings.frames,
                  "Frames to time after a first one; the median is reported (3)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  sub->add_option("--gl", arguments->platform,
                  "Where OpenGL comes from; auto tries EGL, then OSMesa (auto)")
      ->check(CLI::IsMember(kPlatforms))
      ->option_text("auto|egl|osmesa");
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kExamples);
  sub->callback([arguments, &command] {
    check_together(*arguments);
    command = [arguments] { return run(*arguments); };
  });
}

}  // namespace relief::cli
