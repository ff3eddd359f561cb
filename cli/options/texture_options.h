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
};

/// Declares --texture, --acquisition and --points.
void add_texture_options(CLI::App& sub, TextureArguments& arguments);

/// The value of --texture.
[[nodiscard]] TextureChoice texture_choice(const std::filesystem::path& option);

/// All three options.
[[nodiscard]] LoadOptions load_options(const TextureArguments& arguments);

}  // namespace relief::cli
