// What `relief render` can be told.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>

#include "cli/acquire.h"
#include "common/scene.h"
#include "renderer/render.h"

namespace relief::cli {

struct RenderArguments {
  std::filesystem::path input;   ///< a scene, a patch file, a scan or a mesh
  std::filesystem::path output;  ///< with {view} in it for a scene of several views
  TextureArguments texture;
  SceneSettings settings;  ///< what the options say; a scene's settings yield to it
  GlPlatform platform = GlPlatform::Automatic;
  std::optional<int> frames;  ///< by default 3 on OpenGL, 1 of the engines on the CPU
  bool json = false;
};

/// Declares the arguments and options of `sub`, which fill `arguments`. It must outlive `sub`.
void add_render_options(CLI::App& sub, RenderArguments& arguments);

/// What no single option's check can see; throws CLI::ValidationError.
void check_together(const RenderArguments& arguments);

}  // namespace relief::cli
