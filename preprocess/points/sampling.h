// Whether a scan's points lie in lines.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "preprocess/points/surface_scale.h"

namespace relief {

/// The least share of points in lines that makes a scan one of lines. Of ordinary scans at most 4 %
/// lie in lines. Of scans in lines 60 % and more do, or 15 % and more if noise hides their lines.
inline constexpr double kLeastInLines = 0.125;

/// From this scale on looking at each point's neighbours takes longer than a conversion.
inline constexpr std::uint32_t kCoarseScale = 128;

/// How a scan's points lie.
struct Sampling {
  std::uint32_t scale = 0;  ///< the largest that a part of the scan needs; 0: few lie in lines
  bool is_coarse = false;   ///< many need kCoarseScale and more, or even that shows lines only
  Strips strips = Strips::Real;
};

/// The largest of kSurfaceScales that is small beside a scan of so many points; 0 if none is.
[[nodiscard]] std::uint32_t largest_scale(std::size_t points);

/// Looks at the neighbours of 128 points. Takes a hundredth of a conversion. Nothing lies in lines
/// if the user interrupts.
[[nodiscard]] Sampling sampling_of(const std::vector<glm::dvec3>& positions,
                                   const Progress& progress);

}  // namespace relief
