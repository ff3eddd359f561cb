// Normals of tiles that were oriented each for itself, made to agree.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// For each tile, of each of its sheets, whether its normals are to be turned round.
using SheetTurns = std::vector<std::vector<std::uint8_t>>;

/// Where a tile's survey and its rim are kept.
struct SurveyPaths {
  std::filesystem::path survey;
  std::filesystem::path rim;
};

/// Points in the halos of tiles are seen by two tiles, which tells how their sheets lie to each
/// other: joined along those that most points agree on, then turned outward (or to the viewpoint)
/// as the sheets of one scan are. Sheets that touch a tile with given normals follow these.
Result<SheetTurns> join_sheets(const std::vector<SurveyPaths>& tiles, bool has_viewpoint,
                               const Progress& progress);

}  // namespace relief
