// Makes the orientations of normals of different tiles consistent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// For each tile and each of its sheets: whether its normals must be flipped.
using SheetTurns = std::vector<std::vector<std::uint8_t>>;

/// Files of a tile's survey and its rim.
struct SurveyPaths {
  std::filesystem::path survey;
  std::filesystem::path rim;
};

/// Joins the sheets of tiles. Points in halos belong to two tiles, which relates the orientation of
/// their sheets. Sheets are joined along the relations that most points support, but turned
/// against each other only if many do; then together (faces_inward). Sheets that touch a tile with
/// given normals follow these. `are_sure`: a known direction has decided the sides, and none turns.
Result<SheetTurns> join_sheets(const std::vector<SurveyPaths>& tiles, bool are_sure,
                               const Progress& progress);

}  // namespace relief
