// Splats of a textured mesh, for the engine `ewa`.
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief::cli {

struct TextureArguments {
  std::filesystem::path file;              ///< empty: what the mesh says; "none": no texture
  std::optional<std::string> acquisition;  ///< of `ewa`
  std::optional<std::size_t> points;       ///< of `ewa`
};

/// What --texture says to engines that do not make splats of it.
[[nodiscard]] TextureChoice texture_choice(const std::filesystem::path& option);

/// Declares --texture, --acquisition and --points.
void add_texture_options(CLI::App& sub, TextureArguments& arguments);

/// Reads a mesh and its texture and makes splats of them (preprocess/texture/acquire_texture.h) for
/// an engine with the given cutoff. Says on standard error how the fit went.
Result<SplatCloud> acquire_splats(const std::filesystem::path& mesh,
                                  const TextureArguments& arguments, double cutoff,
                                  Progress& progress);

}  // namespace relief::cli
