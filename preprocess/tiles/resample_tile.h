// The last step of a tile: makes patches of its regions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/patch.h"
#include "preprocess/convert.h"
#include "preprocess/resample/resample.h"
#include "preprocess/tiles/survey.h"

namespace relief {

/// A tile's patches, and their errors at its own points, in the tile's unit and frame. Squares and
/// counts add up to the scan's.
struct TilePatches {
  std::vector<Patch> patches;
  std::uint64_t patch_count = 0;
  std::uint64_t points = 0;
  double sum_of_squares = 0.0;  ///< of the points' distances to the patches, squared
  double error_max = 0.0;
  std::uint64_t uncovered = 0;
  ConvertReport texels;  ///< only its counts of texels are set
};

/// A tile that has been surveyed, with what only the surveys of all tiles decide.
struct SurveyedTile {
  TilePoints points;                    ///< as survey_tile left them
  std::span<const ScalarInfo> scalars;  ///< of the points
  TileSurvey survey;
  const std::vector<std::uint8_t>& turns;  ///< whether to flip each sheet
  /// For each point of the halo, its cosine in the TileSurvey of its home tile.
  const std::vector<float>& halo_cosines;
};

/// Makes a tile's patches with the survey's normals and regions. Incomplete if the user interrupts.
[[nodiscard]] TilePatches resample_tile(SurveyedTile tile, const ResampleOptions& options,
                                        Progress& progress);

/// The checkpoint of a tile, beside its patches.
Status save_report(const std::filesystem::path& path, const TilePatches& tile);
Result<TilePatches> load_report(const std::filesystem::path& path);

}  // namespace relief
