// relief render: a patch file, a scan or a scene becomes images.
#include "renderer/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/engine_options.h"
#include "cli/options/image_files.h"
#include "cli/options/output_file.h"
#include "cli/options/render_options.h"
#include "cli/reports/render_report.h"
#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "common/scene/views/camera_path.h"
#include "loader/image_writer.h"
#include "loader/load_scene.h"
#include "loader/models/load_volume.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "renderer/costs/feature_costs.h"

namespace relief::cli {
namespace {

/// Frames in which passes are timed, if the user names no number.
constexpr int kPassFrames = 5;

std::string render_footer() {
  return "SCENE is a .relief file, a scan or mesh, or a .json scene (docs/scene.md) of models in "
         "their\n"
         "positions and views. A scan or mesh is converted in memory with the default options; "
         "ewa\n"
         "and surfel draw its points, raytrace its triangles. Options given here override those of "
         "a\n"
         "scene. By default the camera sees the whole model, obliquely from the front. No display "
         "is\n"
         "needed.\n"
         "\n"
         "Engines:\n" +
         list_engines() +
         "\n"
         "Examples:\n"
         "  relief render dragon.relief -o dragon.png --orbit 30,20\n"
         "  relief render dragon.relief -o dragon.png --material mirror --env studio.hdr\n"
         "  relief render statue.ply -o statue.exr --material unlit --background none --size "
         "4096x4096\n"
         "  relief render dragon.relief -o top.png --eye 0,1,0 --target 0,0,0 --up 0,0,-1 "
         "--orthographic 0.25\n"
         "  relief render statue.ply -o statue.mp4 --turntable 120\n"
         "  relief render statue.ply -o flight.mp4 --path flight.json\n"
         "  relief render suite.json -o 'out/{view}.exr'";
}

/// Sets the outputs of all views. An EXR holds all of them by default, a PNG none but colour.
/// Before anything is read: what is not shown is not read.
void set_outputs(const RenderArguments& arguments, ScenePlan& plan) {
  const bool is_exr = lower_extension(arguments.output) == ".exr";
  for (PlannedView& view : plan.views) {
    std::optional<Outputs>& outputs = view.settings.outputs;
    outputs = is_exr ? outputs.value_or(Outputs{true, true, true, true}) : Outputs{};
  }
}

/// Applies the settings that only the command line has.
void apply(const RenderArguments& arguments, RenderSettings& settings) {
  settings.platform = arguments.platform;
  settings.explain = arguments.explain;
  if (arguments.time_passes) settings.pass_frames = arguments.frames.value_or(kPassFrames);
  if (arguments.explain_cost) settings.cost_turns = arguments.frames.value_or(kCostTurns);
  settings.frames = arguments.frames.value_or(0);
  settings.count_fragments = arguments.frames.has_value();
}

/// The plan's view of an image: of a film all frames have one.
const PlannedView& view_at(const ScenePlan& plan, std::size_t image) {
  return plan.views[plan.film_frames > 0 ? 0 : image];
}

/// Loads, renders and writes.
Result<std::vector<WrittenImage>> make_images(const ScenePlan& plan,
                                              const std::vector<std::filesystem::path>& files,
                                              const RenderArguments& arguments,
                                              ImageWriter& writer) {
  ConsoleProgress progress;
  LoadOptions options = load_options(arguments.texture);
  options.read = arguments.read;
  options.volume = arguments.volume;
  options.colour_by = colour_by_of(arguments.colours);
  options.detail = KeptDetail::OfViews;
  if (arguments.quality) {
    PatchFileOptions of_no_file;
    set_conversion(preset_of(*arguments.quality).convert, options.convert, of_no_file);
  }
  RELIEF_TRY_ASSIGN(const auto scene, load_scene(plan, options, progress));
  const std::optional<ColourScale> legend = arguments.colours.legend ? scene.colours : std::nullopt;
  if (progress.cancelled()) return interrupted_error();
  RELIEF_TRY_ASSIGN(auto views, render_settings_of(plan, scene.patches));
  for (std::size_t i = 0; i < views.size(); ++i) {
    apply(arguments, views[i]);
    complete_look(view_at(plan, i), scene, views[i]);
  }
  std::vector<WrittenImage> written(views.size());
  // A scan that is converted in memory has no sections.
  const FileBytes read = scene.read == SectionBytes{} ? std::nullopt : FileBytes(scene.read);
  const auto keep = [&](std::size_t i, RenderResult result) -> Status {
    const PlannedView& view = view_at(plan, i);
    RELIEF_TRY(writer.write(i, result.image, view.settings.exposure.value_or(0.0), legend));
    result.image.channels.clear();
    written[i] = {view.name, files[i], views[i], std::move(result), scene.colours, read};
    return {};
  };
  RELIEF_TRY(render_views(scene.forms(), views, keep, progress));
  RELIEF_TRY(writer.finish());
  if (writer.lacks_legend()) progress.note("the image is too small for a legend");
  return written;
}

int report(const ScenePlan& plan, const std::vector<WrittenImage>& written, bool json,
           OutputFile& output) {
  if (json && plan.film_frames > 0) return print_json(film_as_json(written));
  if (json)
    return output.finish_json(plan.file.empty() ? as_json(written.front())
                                                : scene_as_json(written));
  if (plan.film_frames > 0) return print_result(film_as_text(written));
  std::string text;
  for (const WrittenImage& image : written) text += as_text(image);
  return output.finish(text);
}

/// Plans the frames of a film whose camera follows a path.
Status plan_path(const RenderArguments& arguments, ScenePlan& plan, double& frames_per_second) {
  RELIEF_TRY_ASSIGN(const CameraPath path, read_camera_path(arguments.path));
  frames_per_second =
      arguments.frames_per_second.value_or(path.frames_per_second.value_or(kUsualFrameRate));
  auto cameras = film_cameras(path, frames_per_second);
  if (!cameras) return make_error("{}: {}", arguments.path.string(), cameras.error().message);
  plan.film_cameras = *std::move(cameras);
  plan.film_frames = plan.film_cameras.size();
  return {};
}

int run_render(RenderArguments arguments) {
  auto output = OutputFile::open(arguments.output, ".png");
  if (!output) return fail(output.error());
  const bool is_standard = output->path() != arguments.output;
  arguments.output = output->path();
  if (const Status opened = open_inputs({arguments.input}); !opened) return fail(opened.error());
  auto plan = plan_scene(arguments.input, arguments.settings);
  if (!plan) return fail(plan.error());
  choose_volume_engine(*plan, arguments.volume);
  if (arguments.quality) complete_views(preset_of(*arguments.quality).render, *plan);
  set_outputs(arguments, *plan);
  const bool follows_path = !arguments.path.empty();
  if ((arguments.turntable > 0 || follows_path) && plan->views.size() > 1) {
    (void)fail(make_error("{}: has {} views; {} makes a film of a single one",
                          arguments.input.string(), plan->views.size(),
                          follows_path ? "--path" : "--turntable"));
    return kWrongUsage;
  }
  double frames_per_second = arguments.frames_per_second.value_or(kUsualFrameRate);
  plan->film_frames = arguments.turntable;
  if (follows_path) {
    if (const Status planned = plan_path(arguments, *plan, frames_per_second); !planned)
      return fail(planned.error());
  }
  if (!names_each_view(arguments.output, *plan)) {
    (void)fail(
        make_error("{}: has {} views; put {{view}} into the output's name, as in out/{{view}}.exr",
                   arguments.input.string(), plan->views.size()));
    return kWrongUsage;
  }
  if (plan->file.empty() && marks_views(arguments.output)) {
    (void)fail(
        make_error("{}: {{view}} stands for the views of a .json scene, and {} is none; leave it "
                   "out",
                   arguments.output.string(), arguments.input.string()));
    return kWrongUsage;
  }
  const auto files = image_files(arguments.output, *plan);
  if (const Status good = check_files(*plan, arguments.texture.file, files); !good)
    return fail(good.error());
  ImageWriter writer(files, frames_per_second, &InterruptedFiles::note_complete);
  const auto kept = [&] {
    const std::size_t count = writer.written();
    return count == 0 ? std::string()
                      : fmt::format("{} of {} images were written", count, files.size());
  };
  const InterruptedFiles unfinished(files, kept);
  auto written = make_images(*plan, files, arguments, writer);
  if (!written) {
    return fail(written.error(), kept());
  }
  if (is_standard) written->front().file = kStandardName;
  return report(*plan, *written, arguments.json, *output);
}

}  // namespace

void add_render(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("render", "Render a patch file, a scan or a scene to images");
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(*sub, *arguments);
  sub->footer(render_footer());
  sub->callback([arguments, &command] {
    // Before options are held against those of the engine.
    const SceneSettings& given = arguments->settings;
    if (!given.engine && (!given.options.empty() || arguments->explain) &&
        has_kernels(arguments->input, arguments->volume))
      arguments->settings.engine = kVolumeEngine;
    check_together(*arguments);
    check_json(arguments->output, arguments->json);
    command = [arguments] { return run_render(*arguments); };
  });
}

}  // namespace relief::cli
