// The files that `relief render` writes.
#pragma once

#include <filesystem>
#include <vector>

#include "common/error.h"
#include "loader/scene/scene_plan.h"

namespace relief::cli {

/// Returns whether `pattern` contains {view}.
[[nodiscard]] bool marks_views(const std::filesystem::path& pattern);

/// Returns whether `pattern` names a different file for each view: it contains {view}, or there is
/// one view.
[[nodiscard]] bool names_each_view(const std::filesystem::path& pattern, const ScenePlan& plan);

/// Returns the file of each view: `pattern` with the view's name for {view}. Of each frame of a
/// film: `pattern` if that is a film, otherwise its name with the frame's number.
[[nodiscard]] std::vector<std::filesystem::path> image_files(const std::filesystem::path& pattern,
                                                             const ScenePlan& plan);

/// Checks before any long work that all files to read exist (including `texture`, unless it is
/// empty or "none") and that all files to write can be written.
Status check_files(const ScenePlan& plan, const std::filesystem::path& texture,
                   const std::vector<std::filesystem::path>& images);

}  // namespace relief::cli
