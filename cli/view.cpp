// relief view: a window that shows scans.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/options/colour_options.h"
#include "cli/options/engine_options.h"
#include "cli/options/read_options.h"
#include "cli/options/render_options.h"
#include "cli/options/texture_options.h"
#include "cli/options/values.h"
#include "common/heap.h"
#include "common/scene/scene.h"
#include "loader/models/load_volume.h"
#include "loader/stream/streamed_patches.h"
#ifdef RELIEF_HAS_VIEWER
#include "viewer/viewer.h"
#endif

namespace relief::cli {
namespace {

struct ViewArguments {
  std::vector<std::filesystem::path> files;
  SceneSettings settings;
  ReadOptions read;
  VolumeReadOptions volume;
  std::filesystem::path texture;
  bool flips_v = false;
  ColourArguments colours;
  std::filesystem::path frame_log;
  std::optional<double> target_ms;
  StreamBudget budget;
};

/// Less would hold a few parts of an image only.
constexpr std::uint64_t kLeastBudget = std::uint64_t{32} << 20U;

constexpr const char* kViewFooter =
    "FILE is a patch file, a scan, a mesh, a raster, a volume, a scene of 3D Gaussians or a .json\n"
    "scene. A scan shows its points at once, and its patches when they are converted. Files can "
    "be\n"
    "dropped on the window.\n"
    "\n"
    "Examples:\n"
    "  relief view dragon.relief\n"
    "  relief view scan1.ply scan2.ply\n"
    "  relief view dragon.relief --material mirror --env studio.exr";

#ifdef RELIEF_HAS_VIEWER
int run_view(const ViewArguments& arguments) {
  return_large_blocks();
  ViewerOptions options;
  options.files = arguments.files;
  options.settings = arguments.settings;
  options.load.read = arguments.read;
  options.load.volume = arguments.volume;
  options.load.textures = texture_choice(arguments.texture, arguments.flips_v);
  options.load.colour_by = colour_by_of(arguments.colours);
  options.budget = arguments.budget;
  options.target_ms = arguments.target_ms;
  options.frame_log = arguments.frame_log;
  options.is_interrupted = interrupted;
  // Ctrl-C closes the window. That is no failure, and nothing is lost if loading takes its time to
  // end.
  InterruptedFiles::note_complete();
  if (const Status shown = run_viewer(std::move(options)); !shown) return fail(shown.error());
  return 0;
}
#else
int run_view(const ViewArguments& /*arguments*/) {
  return fail(
      make_error("this build has no window; install libglfw3-dev and libimgui-dev, and build it "
                 "again"));
}
#endif

/// Options of volumes are held against the engine that draws them.
void choose_engine(ViewArguments& arguments) {
  if (arguments.settings.engine || arguments.settings.options.empty()) return;
  const bool has_kernels =
      std::any_of(arguments.files.begin(), arguments.files.end(),
                  [&](const auto& file) { return shows_kernels(file, arguments.volume); });
  if (has_kernels) arguments.settings.engine = kVolumeEngine;
}

}  // namespace

void add_view(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("view", "Show patch files and scans in a window");
  const auto arguments = std::make_shared<ViewArguments>();
  sub->add_option("FILE", arguments->files, "Files to open (default: an empty window)")
      ->option_text("FILE...");
  add_camera_options(*sub, arguments->settings);
  add_engine_options(*sub, arguments->settings);
  add_material_options(*sub, arguments->settings);
  add_background_options(*sub, arguments->settings);
  add_colour_options(*sub, arguments->colours);
  sub->add_option(
         "--texture", arguments->texture,
         "Texture of a mesh, PNG or JPEG; none: ignore those that the mesh names (default: "
         "those)")
      ->option_text("FILE|none");
  add_flip_option(*sub, arguments->flips_v);
  add_read_options(*sub, arguments->read);
  add_raw_option(*sub, arguments->volume);
  sub->add_option("--target-ms", arguments->target_ms,
                  "Time of a frame while the camera moves, milliseconds, 5 to 1000: coarser "
                  "pictures keep it (default: that of the last window, at first 33)")
      ->check(CLI::Range(5.0, 1000.0))
      ->option_text("MS");
  sub->add_option("--frame-log", arguments->frame_log,
                  "CSV file to write with the time of each frame (default: none)")
      ->option_text("FILE");
  sub->add_option("--memory", arguments->budget.memory,
                  "Memory for what was read of a patch file with tiles, 32M or more (default 512M; "
                  "48M without a GPU)")
      ->transform(CLI::AsSizeValue(false))
      ->check(bytes_from(kLeastBudget))
      ->option_text("BYTES");
  sub->add_option("--gpu-memory", arguments->budget.gpu,
                  "GPU memory for a patch file with tiles, 32M or more: what does not fit is shown "
                  "coarser (default 1G; 240M of memory without a GPU)")
      ->transform(CLI::AsSizeValue(false))
      ->check(bytes_from(kLeastBudget))
      ->option_text("BYTES");
  sub->footer(kViewFooter);
  sub->callback([arguments, &command] {
    check_camera(arguments->settings);
    choose_engine(*arguments);
    check_engine_options(arguments->settings);
    command = [arguments] { return run_view(*arguments); };
  });
}

}  // namespace relief::cli
