// A program of someone else's: loads a scene or a model and writes an image of each view, all with
// the installed libraries. usage: render_scene SCENE FOLDER
#include <fmt/core.h>

#include <relief/common/image/image_io.h>
#include <relief/loader/load_scene.h>
#include <relief/loader/scene/view_settings.h>
#include <relief/renderer/render.h>
#include <filesystem>

namespace {

relief::Status render_scene(const std::filesystem::path& input,
                            const std::filesystem::path& folder) {
  relief::Progress silent;
  RELIEF_TRY_ASSIGN(const auto plan, relief::plan_scene(input, {}));
  RELIEF_TRY_ASSIGN(const auto scene, relief::load_scene(plan, {}, silent));
  RELIEF_TRY_ASSIGN(const auto views, relief::render_settings_of(plan, scene.patches));
  return relief::render_views(
      scene.forms(), views,
      [&](std::size_t view, relief::RenderResult result) {
        if (result.covered_pixels == 0) return relief::Status(relief::Error{"nothing is seen"});
        return relief::write_png(folder / (plan.views[view].name + ".png"), result.image);
      },
      silent);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const relief::Status rendered = render_scene(argv[1], argv[2]);
  if (!rendered) fmt::print(stderr, "{}\n", rendered.error().message);
  return rendered ? 0 : 1;
}
