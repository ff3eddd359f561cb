// From what the user asked for to the pictures that are to be made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "common/error.h"
#include "common/patch.h"
#include "common/scene/scene.h"
#include "renderer/render.h"

namespace relief::cli {

/// One picture to be made.
struct Picture {
  std::string view;  ///< its name; empty without a scene file
  std::filesystem::path output;
  SceneSettings settings;  ///< the options, over the view's, over the scene's
  /// Where the models say something about their materials: the options, over that, over the view's
  /// and the scene's, in the order of materials_said.
  std::vector<MaterialSettings> materials;
};

struct RenderPlan {
  std::filesystem::path scene;  ///< the scene file; empty without one
  std::vector<SceneModel> models;
  std::vector<Picture> pictures;
};

/// Reads the scene, if it is one; any other file is a scene of one model and one view.
Result<RenderPlan> make_plan(const RenderArguments& arguments);

/// Whether every picture has a file of its own.
[[nodiscard]] bool outputs_differ(const RenderPlan& plan, const RenderArguments& arguments);

/// The files to be read, the scene among them. Fails if one is not there: known before the long
/// work. `texture`: one more file to be read, if not empty.
Result<std::vector<std::filesystem::path>> find_inputs(const RenderPlan& plan,
                                                       const std::filesystem::path& texture);

/// The same, and whether every file to be written can be.
Status check_files(const RenderPlan& plan, const std::filesystem::path& texture);

/// What the renderer is told about a picture of the model.
Result<RenderSettings> render_settings_for(const Picture& picture, const PatchModel& model,
                                           const RenderArguments& arguments);

}  // namespace relief::cli
