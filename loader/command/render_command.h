// The `relief render` command that makes an image as a window shows it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "loader/load_scene.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "renderer/settings.h"

namespace relief {

/// An image to be made by a command: what is not in the renderer's settings.
struct CommandedImage {
  std::filesystem::path output = "image.png";
  std::size_t view = 0;            ///< of the plan, whose settings the image began with
  LoadOptions load;                ///< with which the scene was loaded
  bool has_legend = true;          ///< of load.colour_by
  std::optional<double> exposure;  ///< stops, of a PNG or a film; none: as the plan has it
  std::optional<Outputs> outputs;  ///< of an EXR; none: as the plan has them
};

/// A command line for a POSIX shell.
struct RenderCommand {
  std::string line;
  /// What the command line can't say, each a clause that begins with what differs: without any, the
  /// command makes the same image to the byte. (Coloured by height, --up can't be named: then the
  /// camera's axes may be rounded otherwise.)
  std::vector<std::string> missing;
};

/// Returns the command that makes an image with the settings `view` of the plan's scene: only
/// options that differ from what `relief render` does by itself, every number with as many digits
/// as bring it back to the bit. Paths stay as the plan has them, so that it is run in the same
/// folder. Settings of timing, debugging and outputs are not looked at. Fails as
/// render_settings_of() does for the plan.
Result<RenderCommand> render_command(const ScenePlan& plan, const LoadedScene& scene,
                                     const RenderSettings& view, const CommandedImage& image,
                                     std::span<const EngineEntry> among = engines());

}  // namespace relief
