// The first look at a tile: everything that can be known of it without its neighbours and without
// the spacing of the grid.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "common/progress.h"
#include "preprocess/normals/sheets.h"
#include "preprocess/partition/partition.h"
#include "preprocess/tiles/tile_files.h"

namespace relief {

/// The region of points that are in none.
inline constexpr std::uint32_t kNoRegion = UINT32_MAX;

/// What a tile's points are, in the order that merge_duplicates leaves: its own, then the halo's.
struct TileSurvey {
  std::vector<std::uint32_t> number;      ///< of each point in the tile's own file, which place it
                                          ///< has here; empty: the same
  std::vector<glm::vec3> normals;         ///< unit; of each sheet on an unknown side
  std::vector<float> roughness;           ///< as LocalFrames
  Sheets sheets;                          ///< empty if normals were given and good
  std::vector<SheetSums> sums;            ///< of each sheet's own points
  std::vector<std::uint32_t> region;      ///< of the tile's own points
  std::vector<glm::vec3> region_normals;  ///< as Region has them
  /// Of each point in the tile's own file, as Membership has it; kept in a file of its own, as it
  /// is what other tiles want to know.
  std::vector<float> cosines;
  std::uint64_t normals_repaired = 0;  ///< of given ones, the halo's among them
  double area = 0.0;                   ///< that a grid's samples cover, world units squared
  double radius = 0.0;                 ///< of the own points about the scan's centre
};

/// A halo's point: what its home tile may know of it too.
struct RimPoint {
  Home home;
  glm::vec3 normal{0.0F};   ///< as the survey has it
  std::uint32_t sheet = 0;  ///< of the survey's; 0 where it has none
};

/// Merges points at the same position, as clean_points does. Gives the new number of each of the
/// tile's own points; nothing if there were no duplicates.
std::vector<std::uint32_t> merge_duplicates(TilePoints& tile);

struct SurveyOptions {
  double cone_degrees = 0.0;
  bool find_area = false;  ///< it is only needed where the spacing is to be chosen
  glm::dvec3 centre{0.0};  ///< of the scan's bounds
};

/// Merges a tile's duplicates and looks at what is left. Of too few points to be a surface it has
/// no regions. In part if the user interrupts. `tile` gets what is left, with normals.
[[nodiscard]] TileSurvey survey_tile(TilePoints& tile, const SurveyOptions& options,
                                     Progress& progress);

/// Of a tile's halo, the cosines that the surveys of the points' homes have: `load` gives those of
/// a tile.
Result<std::vector<float>> halo_cosines(
    const TilePoints& tile,
    const std::function<Result<std::vector<float>>(std::uint32_t tile)>& load);

/// The halo's points, sorted by home.
[[nodiscard]] std::vector<RimPoint> rim_of(const TilePoints& tile, const TileSurvey& survey);

Status save_survey(const std::filesystem::path& path, const TileSurvey& survey);
Result<TileSurvey> load_survey(const std::filesystem::path& path);

}  // namespace relief
