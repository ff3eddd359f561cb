// Options about the textures of meshes.
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "loader/load_scene.h"

namespace relief::cli {

struct TextureArguments {
  std::filesystem::path file;  ///< empty: the images that the mesh names; "none": no texture
  std::optional<std::string> acquisition;  ///< of `ewa`
  std::optional<std::size_t> points;       ///< of `ewa`
  bool flips_v = false;
};

/// Declares --flip-v.
void add_flip_option(CLI::App& sub, bool& flips_v);

/// Declares --texture, --flip-v, --acquisition and --points.
void add_texture_options(CLI::App& sub, TextureArguments& arguments);

/// The values of --texture and --flip-v.
[[nodiscard]] TextureChoice texture_choice(const std::filesystem::path& option, bool flips_v);

/// All of these options.
[[nodiscard]] LoadOptions load_options(const TextureArguments& arguments);

}  // namespace relief::cli
