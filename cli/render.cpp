// relief render: a patch file or a scan becomes a picture.
#include "renderer/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <variant>

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
    "options. The camera looks at the middle of the model unless --eye says otherwise.\n"
    "No display is needed.\n"
    "\n"
    "Examples:\n"
    "  relief render dragon.relief -o dragon.png --orbit 30,20\n"
    "  relief render dragon.relief -o dragon.png --material mirror --env studio.hdr\n"
    "  relief render statue.ply -o statue.exr --material unlit --background none --size 4096x4096\n"
    "  relief render dragon.relief -o top.png --eye 0,1,0 --target 0,0,0 --up 0,0,-1";

const std::map<std::string, EngineKind> kEngines{{"onepass", EngineKind::Onepass},
                                                 {"raytrace", EngineKind::Raytrace}};
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
  std::optional<int> samples;
  std::optional<int> frames;
  RenderSettings settings;  ///< environment and background; the rest is filled in later
  bool json = false;
};

bool writes_exr(const Arguments& arguments) {
  return ending(arguments.output) == ".exr";
}

Camera camera_for(const Bounds& bounds, double bounding_radius, const Arguments& arguments) {
  const glm::dvec3 centre = 0.5 * (bounds.min + bounds.max);
  if (arguments.eye) {
    return {*arguments.eye, arguments.target.value_or(centre), arguments.up, arguments.fov_degrees};
  }
  return orbit_camera(centre, bounding_radius, arguments.orbit, arguments.fov_degrees,
                      static_cast<double>(arguments.size.width) / arguments.size.height);
}

bool is_onepass(const Arguments& arguments) {
  return kEngines.at(arguments.engine) == EngineKind::Onepass;
}

RenderSettings settings_for(const Bounds& bounds, double bounding_radius,
                            const Arguments& arguments) {
  RenderSettings settings = arguments.settings;
  settings.engine = kEngines.at(arguments.engine);
  settings.width = arguments.size.width;
  settings.height = arguments.size.height;
  settings.camera = camera_for(bounds, bounding_radius, arguments);
  settings.primitive = kPrimitives.at(arguments.primitive);
  settings.interpolation = kInterpolations.at(arguments.interpolation);
  settings.material = kMaterials.at(arguments.material);
  settings.platform = kPlatforms.at(arguments.platform);
  settings.raytrace.samples = arguments.samples.value_or(settings.raytrace.samples);
  settings.frames = arguments.frames.value_or(is_onepass(arguments) ? settings.frames : 1);
  if (writes_exr(arguments))
    settings.outputs = arguments.outputs.value_or(Outputs{true, true, true, true});
  return settings;
}

template <class T>
nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json as_json(const RenderResult& result, const Arguments& arguments) {
  const auto of_onepass = [&arguments](const std::string& value) {
    return is_onepass(arguments) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  return {{"engine", arguments.engine},
          {"primitive", of_onepass(arguments.primitive)},
          {"interpolation", of_onepass(arguments.interpolation)},
          {"material", arguments.material},
          {"renderer", result.renderer},
          {"width", result.image.width},
          {"height", result.image.height},
          {"frame_ms", result.frame_ms},
          {"gpu_ms", value_or_null(result.gpu_ms)},
          {"covered_pixels", result.covered_pixels},
          {"fragments", value_or_null(result.fragments)}};
}

std::string as_text(const RenderResult& result, const Arguments& arguments) {
  const std::string fragments =
      result.fragments ? fmt::format("{}", *result.fragments) : std::string("not counted");
  const std::string engine = is_onepass(arguments)
                                 ? fmt::format("{}, {}, {}", arguments.engine, arguments.primitive,
                                               arguments.interpolation)
                                 : arguments.engine;
  return fmt::format(
      "{}\n"
      "  engine          {}, {}\n"
      "  renderer        {}\n"
      "  size            {}x{}\n"
      "  frame           {:.2f} ms\n"
      "  covered pixels  {}\n"
      "  fragments       {}\n",
      arguments.output.string(), engine, arguments.material, result.renderer, result.image.width,
      result.image.height, result.frame_ms, result.covered_pixels, fragments);
}

Result<RenderResult> load_and_draw(const Arguments& arguments, Progress& progress) {
  const auto model = load_model(arguments.scene, progress);
  if (!model) return model.error();
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("render", 0);
  return render(*model, settings_for(model->bounds, model->bounding_radius, arguments), progress);
}

Result<RenderResult> load_and_trace(const Arguments& arguments, Progress& progress) {
  const auto traceable = load_traceable(arguments.scene, progress);
  if (!traceable) return traceable.error();
  if (progress.cancelled()) return interrupted_error();
  const RenderSettings settings =
      settings_for(traceable->bounds, traceable->bounding_radius, arguments);
  return std::visit([&](const auto& model) { return render(model, settings, progress); },
                    traceable->model);
}

/// Loads, renders and writes.
Result<RenderResult> render_file(const Arguments& arguments) {
  ConsoleProgress progress;
  auto result = is_onepass(arguments) ? load_and_draw(arguments, progress)
                                      : load_and_trace(arguments, progress);
  if (!result) return result.error();
  if (progress.cancelled()) return interrupted_error();
  const Status written = writes_exr(arguments) ? write_exr(arguments.output, result->image)
                                               : write_png(arguments.output, result->image);
  if (!written) return written.error();
  return result;
}

int run(const Arguments& arguments) {
  const Status writable =
      check_output(arguments.output, {arguments.scene, arguments.settings.environment});
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
  if (arguments.eye && arguments.eye == arguments.target) {
    throw CLI::ValidationError("--target", "must not be where --eye is");
  }
  if (arguments.samples && is_onepass(arguments)) {
    throw CLI::ValidationError("--samples", "needs --engine raytrace");
  }
  if (arguments.up == glm::dvec3(0.0)) {
    throw CLI::ValidationError("--up", "must not be 0,0,0");
  }
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
         "What turns the model into pixels: onepass draws patches, raytrace follows rays to "
         "a mesh's own triangles or to those of the patches (onepass)")
      ->check(CLI::IsMember(kEngines))
      ->option_text("onepass|raytrace");
  sub.add_option("--samples", arguments.samples,
                 "Rays a pixel of raytrace; 1 is not antialiased (16)")
      ->check(CLI::Range(1, 65536))
      ->option_text("N");
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
  sub->add_option_function<std::string>(
         "--outputs", [arguments](const std::string& s) { arguments->outputs = parse_outputs(s); },
         "What an .exr holds: all, colour, or some of normal,depth,uv,patch beside the colour "
         "(all)")
      ->option_text("LIST");
  sub->add_option("--frames", arguments->frames,
                  "Frames to time; the median is reported (onepass: 3 after a first one, raytrace: "
                  "1)")
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
