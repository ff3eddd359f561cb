// Footprints as tiles add them up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace relief::volume::cpu {

/// Pixels of an image, row by row from the top: both ends included.
struct Box {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;

  [[nodiscard]] bool is_empty() const { return left > right || top > bottom; }
};

/// A footprint as tiles add it up: peak * 2^e, where e = (xx dx + xy dy) dx + yy dy^2 is at most 0
/// and not below the cutoff, at (dx, dy) from the centre. Pixels, x to the right and y downward.
struct Splat {
  float x = 0.0F;  ///< centre, from the image's upper left corner
  float y = 0.0F;
  float xx = 0.0F;
  float xy = 0.0F;
  float yy = 0.0F;
  float peak = 0.0F;
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  // From row to row, and from run to run of kLanes pixels, weights change by factors, and these by
  // constant ones:
  float least = 0.0F;       ///< 2^e at the cutoff
  float down = 0.0F;        ///< of the factor to the next row, from row to row
  float right = 0.0F;       ///< of the factor to the next run, from run to run
  float slanted = 0.0F;     ///< of the factor to the next row, from run to run
  bool is_steep = false;    ///< e differs by more than kSteep in the box: factors are of no use
  std::uint32_t group = 0;  ///< those of one group are one layer
  Box box;                  ///< in the image
};

/// Where a splat's kernel lies and what it faces: for images that show it, and that end it at
/// surfaces.
struct SplatSurface {
  /// Along the view axis, world units: a kernel's depths at a pixel are a Gaussian about
  /// depth + right * dx + down * dy, at (dx, dy) from the splat's centre.
  float depth = 0.0F;
  float right = 0.0F;
  float down = 0.0F;
  float per_deviation = 0.0F;  ///< 1 / its standard deviation
  glm::vec3 normal{0.0F};
};

/// Deviations of depths that are smaller count as that: 1 / deviation is finite.
inline constexpr float kLeastDeviation = 1e-30F;

/// Weights that differ by more are not found from those of the row before, of which nothing may be
/// left.
inline constexpr float kSteep = 80.0F;

/// Pixels along each side of a tile. A layer, 16 KB, stays in a core's first cache; a splat is in
/// fewer of them than of the reference's.
inline constexpr int kSide = 32;
/// From row to row: runs of pixels that begin within a tile may end beyond it.
inline constexpr std::size_t kStride = kSide + 8;
/// Where a pixel of a tile is in an array of its pixels.
[[nodiscard]] inline std::size_t place_of(int x, int y) {
  return static_cast<std::size_t>(y) * kStride + static_cast<std::size_t>(x);
}

}  // namespace relief::volume::cpu
