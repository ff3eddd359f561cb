// The first step of a tile: computes everything that needs neither its neighbours nor the grid
// spacing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "common/progress.h"
#include "preprocess/normals/known_sides.h"
#include "preprocess/normals/sheets.h"
#include "preprocess/partition/partition.h"
#include "preprocess/tiles/tile_files.h"

namespace relief {

/// The region index of points in none.
inline constexpr std::uint32_t kNoRegion = UINT32_MAX;

/// Attributes of a tile's points, in the order of merge_duplicates: own points, then the halo.
struct TileSurvey {
  std::vector<std::uint32_t>
      number;  ///< new index of each point of the tile's own file, or kNoPoint; empty: unchanged
  std::vector<glm::vec3> normals;         ///< unit; the side of each sheet is not yet decided
  std::vector<float> roughness;           ///< as in LocalFrames
  Sheets sheets;                          ///< empty if normals were given and good
  std::vector<SheetSums> sums;            ///< of each sheet's own points
  std::vector<std::uint32_t> region;      ///< of the tile's own points
  std::vector<glm::vec3> region_normals;  ///< as in Region
  /// As in Membership, for each point of the tile's own file. Kept in a separate file, because
  /// other tiles read it.
  std::vector<float> cosines;
  std::uint64_t normals_repaired = 0;  ///< of given normals, those of the halo included
  double area = 0.0;                   ///< covered by a grid's samples, tile units squared
  double radius = 0.0;                 ///< of the own points about the scan's centre
};

/// A point of the halo, as this tile sees it; its home tile has its own view.
struct RimPoint {
  Home home;
  glm::vec3 normal{0.0F};   ///< as in the survey
  std::uint32_t sheet = 0;  ///< sheet of the survey; 0 if it has no sheets
};

/// Merges points at equal positions, as clean_points does. Returns the new index of each point of
/// the tile's own file, kNoPoint for those dropped before (TilePoints::number); empty: unchanged.
std::vector<std::uint32_t> merge_duplicates(TilePoints& tile);

struct SurveyOptions {
  double cone_degrees = 0.0;
  SideChoice side;         ///< that normals face
  bool seams = false;      ///< patches will meet: regions end at creases
  bool find_area = false;  ///< only needed to choose the spacing
  glm::dvec3 centre{0.0};  ///< of the scan's bounds
};

/// Merges a tile's duplicates and surveys the remaining points, which `tile` then has, with
/// normals. Too few points for a surface give no regions. Incomplete if the user interrupts.
[[nodiscard]] TileSurvey survey_tile(TilePoints& tile, const SurveyOptions& options,
                                     Progress& progress);

/// Returns, for each point of a tile's halo, its cosine in the survey of its home tile. `load`
/// returns the cosines of a tile.
Result<std::vector<float>> halo_cosines(
    const TilePoints& tile,
    const std::function<Result<std::vector<float>>(std::uint32_t tile)>& load);

/// Returns the points of the halo, sorted by home.
[[nodiscard]] std::vector<RimPoint> rim_of(const TilePoints& tile, const TileSurvey& survey);

Status save_survey(const std::filesystem::path& path, const TileSurvey& survey);
Result<TileSurvey> load_survey(const std::filesystem::path& path);

}  // namespace relief
