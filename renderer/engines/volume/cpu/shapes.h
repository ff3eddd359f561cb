// Footprints of kLanes kernels, as tiles add them up.
#pragma once

#include <cstdint>
#include <numbers>

#include "renderer/engines/volume/cpu/distant_lights.h"
#include "renderer/engines/volume/cpu/lanes.h"
#include "renderer/engines/volume/cpu/splat.h"

namespace relief::volume::cpu {

/// Exponents of 2 in place of e, and the half of exp(-q / 2).
inline constexpr float kHalfLog2E = static_cast<float>(0.5 * std::numbers::log2e);

/// As Splat says.
struct Shapes {
  Floats x, y;  ///< of the centre, from the image's upper left corner
  Floats xx, xy, yy;
  Floats reach_x, reach_y;
  Floats peak;
  Floats cutoff;
};

/// The factors by which weights change; as Splat says.
struct Factors {
  Floats least, down, right, slanted;
  Ints is_steep;
};

RELIEF_IN_LANES Factors factors_of(const Shapes& shapes) {
  const Floats x = shapes.reach_x + kLanes;  // runs begin up to kLanes pixels before the box
  const Floats y = shapes.reach_y + 1.0F;
  const Floats slant = larger(shapes.xy, -shapes.xy);
  const Floats lowest = shapes.xx * x * x - slant * x * y + shapes.yy * y * y;
  const auto factor = [](const Floats& e) RELIEF_INLINED {
    return exp2_of(smaller(larger(e, all_of(kLeastExponent)), all_of(-kLeastExponent)));
  };
  return {.least = factor(-kHalfLog2E * shapes.cutoff),
          .down = factor(2.0F * shapes.yy),
          .right = factor(2.0F * kLanes * kLanes * shapes.xx),
          .slanted = factor(kLanes * shapes.xy),
          .is_steep = ~(lowest > -kSteep)};
}

/// kLanes boxes of pixels.
struct Boxes {
  Ints left, right, top, bottom;

  [[nodiscard]] Box of(int lane) const {
    return {left[lane], right[lane], top[lane], bottom[lane]};
  }
};

/// Rounded up from the lower ends and down from the upper ones, within the image.
RELIEF_IN_LANES Boxes boxes_of(const Shapes& shapes, float width, float height) {
  const auto end = [](const Floats& at, float size) RELIEF_INLINED {
    const Floats within = smaller(larger(at + 0.5F, all_of(0.0F)), all_of(size));
    return __builtin_convertvector(within, Ints);
  };
  return {.left = end(shapes.x - shapes.reach_x, width),
          .right = end(shapes.x + shapes.reach_x, width) - 1,
          .top = end(shapes.y - shapes.reach_y, height),
          .bottom = end(shapes.y + shapes.reach_y, height) - 1};
}

/// The splat of a lane.
RELIEF_IN_LANES Splat splat_of(const Shapes& shapes, const Factors& factors, const Boxes& boxes,
                               const Vectors& colours, std::uint32_t group, int lane) {
  return {.x = shapes.x[lane],
          .y = shapes.y[lane],
          .xx = shapes.xx[lane],
          .xy = shapes.xy[lane],
          .yy = shapes.yy[lane],
          .peak = shapes.peak[lane],
          .red = colours.x[lane],
          .green = colours.y[lane],
          .blue = colours.z[lane],
          .least = factors.least[lane],
          .down = factors.down[lane],
          .right = factors.right[lane],
          .slanted = factors.slanted[lane],
          .is_steep = factors.is_steep[lane] != 0,
          .group = group,
          .box = boxes.of(lane)};
}

}  // namespace relief::volume::cpu
