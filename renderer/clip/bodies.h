// Clip partners of several bodies, which do not clip each other.
#pragma once

#include <cstddef>
#include <span>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/clip_partners.h"

namespace relief {

/// Finds the lines that clip the discs, of each body apart: what is a sharp edge between two bodies
/// that touch depends on where they stand, not on their shapes. `ends`: of each body the end of its
/// discs, ascending, the last all of them; empty: one body. Fails only if it is interrupted.
Result<ClipPartners> find_clip_partners_of_bodies(const SplatDiscs& discs,
                                                  std::span<const std::size_t> ends,
                                                  const ClipSettings& settings, Progress& progress);

}  // namespace relief
