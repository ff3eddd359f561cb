// The kernels of a grid, which have one variance, in the image: as footprint_of()
// (renderer/volume/splats/footprint.h), in single precision and kLanes at once.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "renderer/engines/volume/cpu/shapes.h"
#include "renderer/view/view.h"
#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief::volume::cpu {

class GridProjection {
 public:
  /// `in_camera`: the variance in camera space. The rule's filter is Ewa or Unfiltered.
  GridProjection(const RayCamera& camera, const View& view, const FootprintRule& rule,
                 const Variance& in_camera)
      : rotation_(camera.rotation),
        scale_(camera.scale),
        middle_(camera.middle),
        height_(static_cast<float>(view.height)),
        orthographic_(camera.orthographic),
        xx_(static_cast<float>(in_camera.xx)),
        xy_(static_cast<float>(in_camera.xy)),
        xz_(static_cast<float>(in_camera.xz)),
        yy_(static_cast<float>(in_camera.yy)),
        yz_(static_cast<float>(in_camera.yz)),
        zz_(static_cast<float>(in_camera.zz)),
        near_(orthographic_ ? 0.0F : std::sqrt(std::max(zz_, 0.0F))),
        filter_(static_cast<float>(rule.filter == VolumeFilter::Ewa ? kLowPassVariance : 0.0)),
        cutoff_(static_cast<float>(rule.cutoff)),
        per_area_(static_cast<float>(
            1.0 / (2.0 * std::numbers::pi * (1.0 - std::exp(-0.5 * rule.cutoff))))) {}

  struct Projected {
    Shapes shapes;
    Ints is_valid;  ///< before the eye, with an area
    Floats depth;   ///< along the view axis
    // Before the filter: the Jacobian's first two rows are a (1, 0, -x) and b (0, 1, -y).
    Floats a, b, x_depth, y_depth, xx, xy, yy;
  };

  /// `from_eye`: where the centres are.
  RELIEF_IN_LANES Projected project(const Vectors& from_eye, const Floats& weight) const {
    const auto turned = [&](glm::length_t row) RELIEF_INLINED {
      return rotation_[0][row] * from_eye.x + rotation_[1][row] * from_eye.y +
             rotation_[2][row] * from_eye.z;
    };
    Projected p;
    const Floats tx = turned(0);
    const Floats ty = turned(1);
    p.depth = turned(2);
    const Floats per_depth = orthographic_ ? all_of(1.0F) : 1.0F / p.depth;
    const Floats x = orthographic_ ? Floats{} : tx * per_depth;
    const Floats y = orthographic_ ? Floats{} : ty * per_depth;
    p.a = scale_.x * per_depth;
    p.b = scale_.y * per_depth;
    p.x_depth = xz_ - x * zz_;
    p.y_depth = yz_ - y * zz_;
    p.xx = p.a * p.a * (xx_ - x * xz_ - x * p.x_depth);
    p.xy = p.a * p.b * (xy_ - x * yz_ - y * p.x_depth);
    p.yy = p.b * p.b * (yy_ - y * yz_ - y * p.y_depth);
    const Floats xx = p.xx + filter_;
    const Floats yy = p.yy + filter_;
    const Floats determinant = xx * yy - p.xy * p.xy;
    const Floats per_determinant = 1.0F / determinant;
    const Floats area = p.a * p.b * root_of(1.0F + x * x + y * y);
    p.shapes = {.x = middle_.x + p.a * tx,
                .y = height_ - middle_.y - p.b * ty,
                .xx = -kHalfLog2E * yy * per_determinant,
                .xy = -2.0F * kHalfLog2E * p.xy * per_determinant,
                .yy = -kHalfLog2E * xx * per_determinant,
                .reach_x = root_of(cutoff_ * xx),
                .reach_y = root_of(cutoff_ * yy),
                .peak = weight * area * per_area_ * root_of(per_determinant),
                .cutoff = all_of(cutoff_)};
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    p.is_valid = (p.depth > near_) & (determinant > 0.0F) & (p.shapes.peak < kInfinity);
    return p;
  }

  /// How depths change over the image, as project_kernel() has it.
  struct Depths {
    Floats right, up, per_deviation;
  };
  RELIEF_IN_LANES Depths depths_of(const Projected& p) const {
    const Floats determinant = p.xx * p.yy - p.xy * p.xy;
    const Floats per_determinant = determinant > 0.0F ? 1.0F / determinant : Floats{};
    const Floats cx = p.a * p.x_depth;
    const Floats cy = p.b * p.y_depth;
    const Floats right = (p.yy * cx - p.xy * cy) * per_determinant;
    const Floats up = (p.xx * cy - p.xy * cx) * per_determinant;
    const Floats along = larger(zz_ - right * cx - up * cy, Floats{});
    return {right, up, 1.0F / larger(root_of(along), all_of(kLeastDeviation))};
  }

 private:
  glm::mat3 rotation_;  ///< world to camera
  glm::vec2 scale_;
  glm::vec2 middle_;
  float height_;
  bool orthographic_;
  float xx_, xy_, xz_, yy_, yz_, zz_;  ///< the variance in camera space
  float near_;
  float filter_;
  float cutoff_;
  float per_area_;  ///< what lies beyond the cutoff is not lost
};

}  // namespace relief::volume::cpu
