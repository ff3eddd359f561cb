// `relief view`: a window that shows scans.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/scene/scene.h"
#include "loader/load_scene.h"
#include "loader/stream/streamed_patches.h"

namespace relief {

struct ViewerOptions {
  std::vector<std::filesystem::path> files;  ///< opened first; may be empty
  SceneSettings settings;                    ///< the first look and camera
  LoadOptions load;                          ///< how files are read
  std::filesystem::path frame_log;           ///< a CSV of all frames; empty: none is written
  std::optional<double> target_ms;           ///< of a frame while something moves; none: as
                                             ///< remembered
  StreamBudget budget = {};  ///< of files that are read as views need them; 0: what suits the GPU
  std::function<bool()> is_interrupted = [] { return false; };  ///< asked now and then
};

/// Opens a window and shows files until the user closes it. To be called on the program's first
/// thread. Fails, with one sentence, without a display, OpenGL 4.5 or one of the first files.
/// A file that turns out to be broken later gives a message in the window.
Status run_viewer(ViewerOptions options);

}  // namespace relief
