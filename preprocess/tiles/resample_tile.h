// The last look at a tile: its regions become patches.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/patch.h"
#include "preprocess/convert.h"
#include "preprocess/tiles/survey.h"

namespace relief {

/// A tile's patches, and how well they render its own points. Squares and counts add up to the
/// scan's.
struct TilePatches {
  std::vector<Patch> patches;
  std::uint64_t patch_count = 0;
  std::uint64_t points = 0;
  double sum_of_squares = 0.0;  ///< of the points' distances to the patches, world units squared
  double error_max = 0.0;       ///< world units
  std::uint64_t uncovered = 0;
  ConvertReport texels;  ///< its counts of texels alone
};

/// Makes a tile's patches from its points, as survey_tile left them, with the normals and regions
/// of its survey, whose sheets are turned round as `turns` says (one for each). `halo_cosines`: of
/// each of the halo's points, as TileSurvey has it where it is at home. In part if the user
/// interrupts.
[[nodiscard]] TilePatches resample_tile(TilePoints tile, TileSurvey survey,
                                        const std::vector<std::uint8_t>& turns,
                                        const std::vector<float>& halo_cosines,
                                        const ConvertOptions& options, double spacing,
                                        bool normals_estimated, Progress& progress);

/// What is kept of a tile beside its patches.
Status save_report(const std::filesystem::path& path, const TilePatches& tile);
Result<TilePatches> load_report(const std::filesystem::path& path);

}  // namespace relief
