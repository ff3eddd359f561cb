// The options of `relief convert`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <vector>

#include "common/patch_file/patch_file.h"
#include "preprocess/convert_options.h"
#include "preprocess/tiles/tile_options.h"

namespace relief::cli {

/// What `relief convert` is asked for.
struct ConvertArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::filesystem::path texture;  ///< as texture_choice has it
  bool flips_v = false;
  ConvertOptions options;
  PatchFileOptions file;
  TileOptions tiles{.memory_bytes = 0};  ///< 0: no limit, in one piece
  bool clean = false;
  double thin = 0.0;  ///< side of the cubes, scan's unit; 0: no thinning
  bool json = false;
};

/// Declares the arguments and options of `sub`, which fill `arguments`. It must outlive `sub`.
void add_convert_options(CLI::App& sub, ConvertArguments& arguments);

/// Checks all options together. Throws CLI::ValidationError.
void check_together(const ConvertArguments& arguments);

}  // namespace relief::cli
