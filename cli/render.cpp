// relief render: a patch file, a scan or a scene becomes pictures.
#include "renderer/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/load_scene.h"
#include "cli/options/paths.h"
#include "cli/options/render_options.h"
#include "cli/options/render_plan.h"
#include "cli/reports/render_report.h"
#include "common/image/image_io.h"

namespace relief::cli {
namespace {

constexpr const char* kRenderExamples =
    "In brackets: what is taken where an option is not given.\n"
    "SCENE is a .relief file, or a scan or mesh that is converted in memory with the default\n"
    "options (ewa draws its points and raytrace its triangles as they are), or a .json scene\n"
    "(docs/scene.md): models in their places and views. Options given\n"
    "here override a scene's. The camera looks at the middle of the model unless --eye says\n"
    "otherwise. No display is needed.\n"
    "\n"
    "Examples:\n"
    "  relief render dragon.relief -o dragon.png --orbit 30,20\n"
    "  relief render dragon.relief -o dragon.png --material mirror --env studio.hdr\n"
    "  relief render statue.ply -o statue.exr --material unlit --background none --size 4096x4096\n"
    "  relief render dragon.relief -o top.png --eye 0,1,0 --target 0,0,0 --up 0,0,-1 "
    "--orthographic 0.25\n"
    "  relief render suite.json -o 'out/{view}.exr'";

/// An EXR keeps the scene's light; a PNG has it as a camera with that exposure (stops) takes it,
/// the background with it.
Status write_image(const std::filesystem::path& path, Image& image, double exposure) {
  if (ending(path) == ".exr") return write_exr(path, image);
  const auto factor = static_cast<float>(std::exp2(exposure));
  for (Channel& channel : image.channels) {
    if (channel.name != "R" && channel.name != "G" && channel.name != "B") continue;
    for (float& value : channel.values) value *= factor;
  }
  return write_png(path, image);
}

EngineNeeds needs_of(const RenderPlan& plan) {
  EngineNeeds needs;
  for (const Picture& picture : plan.pictures) {
    const EngineKind engine = picture.settings.engine.value_or(RenderSettings{}.engine);
    needs.patches |= is_on_opengl(engine);
    needs.ewa |= engine == EngineKind::Ewa;
    needs.raytrace |= engine == EngineKind::Raytrace;
  }
  return needs;
}

Result<std::vector<RenderSettings>> views_of(const RenderPlan& plan, const PatchModel& extent,
                                             const RenderArguments& arguments) {
  std::vector<RenderSettings> views;
  for (const Picture& picture : plan.pictures) {
    RELIEF_TRY_ASSIGN(auto settings, render_settings_for(picture, extent, arguments));
    views.push_back(std::move(settings));
  }
  return views;
}

Result<LoadedScene> load(const RenderPlan& plan, const RenderArguments& arguments,
                         Progress& progress) {
  const EngineNeeds needs = needs_of(plan);
  const TextureChoice textures = texture_choice(arguments.texture.file);
  if (!needs.ewa || textures.image.empty())
    return load_scene(plan.models, textures, needs, progress,
                      [&](const PatchModel& extent) { return views_of(plan, extent, arguments); });
  auto splats = acquire_splats(arguments.input, arguments.texture,
                               arguments.settings.cutoff.value_or(EwaSettings{}.cutoff), progress);
  if (!splats) return splats.error();
  LoadedScene scene;
  scene.patches.bounds = bounds_of(splats->positions);
  scene.patches.bounding_radius = bounding_radius(splats->positions, scene.patches.bounds);
  scene.splats = std::move(*splats);
  return scene;
}

/// Loads, renders and writes. `count`: how many pictures are written, also after a failure.
Result<std::vector<WrittenImage>> make_images(const RenderPlan& plan,
                                              const RenderArguments& arguments,
                                              std::size_t& count) {
  ConsoleProgress progress;
  RELIEF_TRY_ASSIGN(const auto scene, load(plan, arguments, progress));
  if (progress.cancelled()) return interrupted_error();
  RELIEF_TRY_ASSIGN(const auto views, views_of(plan, scene.patches, arguments));
  std::vector<WrittenImage> written(views.size());
  const Status done = render_views(
      scene.forms(), views,
      [&](std::size_t view, RenderResult result) {
        const Picture& picture = plan.pictures[view];
        Status saved =
            write_image(picture.output, result.image, picture.settings.exposure.value_or(0.0));
        if (!saved) return saved;
        result.image.channels.clear();
        written[view] = {views[view], std::move(result)};
        ++count;
        return Status();
      },
      progress);
  if (!done) return done.error();
  return written;
}

int report(const RenderPlan& plan, const std::vector<WrittenImage>& written, bool json) {
  if (json)
    return print_json(plan.scene.empty() ? as_json(written.front()) : scene_as_json(plan, written));
  std::string text;
  for (std::size_t i = 0; i < written.size(); ++i) text += as_text(plan.pictures[i], written[i]);
  return print_result(text);
}

int run_render(const RenderArguments& arguments) {
  const auto plan = make_plan(arguments);
  if (!plan) return fail(plan.error());
  if (!outputs_differ(*plan, arguments)) {
    (void)fail(
        make_error("{}: has {} views; put {{view}} into the output's name, as in "
                   "out/{{view}}.exr",
                   arguments.input.string(), plan->pictures.size()));
    return kWrongUsage;
  }
  if (const Status good = check_files(*plan, arguments.texture.file); !good)
    return fail(good.error());
  std::size_t count = 0;
  const auto written = make_images(*plan, arguments, count);
  if (!written) {
    return fail(written.error(), count == 0 ? std::string()
                                            : fmt::format("{} of {} pictures were written", count,
                                                          plan->pictures.size()));
  }
  return report(*plan, *written, arguments.json);
}

}  // namespace

void add_render(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("render", "Render a patch file, a scan or a scene to pictures");
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(*sub, *arguments);
  sub->footer(kRenderExamples);
  sub->callback([arguments, &command] {
    check_together(*arguments);
    command = [arguments] { return run_render(*arguments); };
  });
}

}  // namespace relief::cli
