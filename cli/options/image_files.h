// The files that `relief render` writes.
#pragma once

#include <filesystem>
#include <vector>

#include "common/error.h"
#include "loader/scene_plan.h"

namespace relief::cli {

/// Whether `pattern` names a file of its own for each view: it has {view} in it, or there is one
/// view.
[[nodiscard]] bool names_each_view(const std::filesystem::path& pattern, const ScenePlan& plan);

/// The file of each view: `pattern` with the view's name for {view}.
[[nodiscard]] std::vector<std::filesystem::path> image_files(const std::filesystem::path& pattern,
                                                             const ScenePlan& plan);

/// Whether all files to read are there (`texture` too, unless it is empty or "none") and all files
/// to write can be written: known before any long work.
Status check_files(const ScenePlan& plan, const std::filesystem::path& texture,
                   const std::vector<std::filesystem::path>& images);

}  // namespace relief::cli
