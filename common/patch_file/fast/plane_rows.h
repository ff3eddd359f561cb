// Undoes the plane prediction of codec 1 (prediction.h), many nodes at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/patch_file/fast/prediction.h"

namespace relief {

/// Number of differences after the last one that undo_plane may read.
inline constexpr std::size_t kDifferencePadding = 8;

/// Sets each kept value to its difference (residuals.h: unzigzag) plus predict_plane, modulo 2^16,
/// and all others to `hole`. `differences` has one value for each kept node, and kDifferencePadding
/// more. Returns whether a kept value is 65535.
bool undo_plane(const KeptGrid& grid, std::span<const std::uint16_t> differences, std::int32_t hole,
                std::span<std::int32_t> values);

}  // namespace relief
