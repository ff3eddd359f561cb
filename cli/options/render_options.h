// The options of `relief render`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>

#include "cli/options/colour_options.h"
#include "cli/options/quality.h"
#include "cli/options/texture_options.h"
#include "common/scene/scene.h"
#include "preprocess/volumes/read_volume.h"
#include "renderer/render.h"

namespace relief::cli {

struct RenderArguments {
  std::filesystem::path input;   ///< a scene, a patch file, a scan or a mesh
  std::filesystem::path output;  ///< has {view} in it for a scene of several views
  TextureArguments texture;
  ReadOptions read;  ///< of scans and meshes
  VolumeReadOptions volume;
  ColourArguments colours;
  SceneSettings settings;  ///< overrides those of a scene
  std::optional<Quality> quality;
  GlPlatform platform = GlPlatform::Automatic;
  std::size_t turntable = 0;                ///< frames of a film; 0: none
  std::filesystem::path path;               ///< camera path of a film; empty: none
  std::optional<double> frames_per_second;  ///< of a film
  std::optional<int> frames;                ///< to be timed; by default the image is drawn once
  bool explain = false;
  bool explain_cost = false;  ///< implies `explain`
  bool time_passes = false;
  bool json = false;
};

/// Declares the arguments and options of `sub`, which fill `arguments`. It must outlive `sub`.
void add_render_options(CLI::App& sub, RenderArguments& arguments);

/// Parts of them, for other subcommands: image size and camera, material and environment, OpenGL
/// platform.
void add_background_options(CLI::App& sub, SceneSettings& settings);
void add_camera_options(CLI::App& sub, SceneSettings& settings);
void add_material_options(CLI::App& sub, SceneSettings& settings);
void add_platform_option(CLI::App& sub, GlPlatform& platform);

/// Checks the camera's options together. Throws CLI::ValidationError.
void check_camera(const SceneSettings& settings);

/// Checks all options together. Throws CLI::ValidationError.
void check_together(const RenderArguments& arguments);

}  // namespace relief::cli
