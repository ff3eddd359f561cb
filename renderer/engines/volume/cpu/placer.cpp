#include "renderer/engines/volume/cpu/placer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/engines/volume/cpu/lanes.h"

namespace relief::volume::cpu {
namespace {

constexpr float kHalfLog2E = static_cast<float>(0.5 * std::numbers::log2e);

/// kLanes footprints as tiles add them up.
struct Shapes {
  Floats x, y;  ///< of the centre, from the image's upper left corner
  Floats xx, xy, yy;
  Floats reach_x, reach_y;
  Floats peak;
  Floats cutoff;
};

/// The factors by which weights change.
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

/// A variance in single precision.
struct FloatVariance {
  float xx, xy, xz, yy, yz, zz;

  explicit FloatVariance(const Variance& v)
      : xx(static_cast<float>(v.xx)),
        xy(static_cast<float>(v.xy)),
        xz(static_cast<float>(v.xz)),
        yy(static_cast<float>(v.yy)),
        yz(static_cast<float>(v.yz)),
        zz(static_cast<float>(v.zz)) {}
};

/// Values of the first kLanes kernels of a list.
RELIEF_IN_LANES Vectors gathered(const std::vector<glm::vec3>& values,
                                 std::span<const std::uint32_t> kernels) {
  Vectors lanes;
  for (int i = 0; i < kLanes; ++i) {
    const glm::vec3& value = values[kernels[static_cast<std::size_t>(i)]];
    lanes.x[i] = value.x;
    lanes.y[i] = value.y;
    lanes.z[i] = value.z;
  }
  return lanes;
}

}  // namespace

Placer::Placer(const VolumeFrame& frame) : frame_(frame), camera_(ray_camera(frame.view)) {
  const KernelCloud& cloud = frame.cloud;
  if (cloud.variances.size() != 1) return;
  in_camera_ = to_camera(camera_, cloud.variances.front());
  const FootprintRule& rule = frame.footprints.front();
  takes_lanes_ = cloud.starts.size() <= 1 && cloud.is_surface.empty() &&
                 rule.weight == KernelWeight::Integral &&
                 (rule.filter == VolumeFilter::Ewa || rule.filter == VolumeFilter::Unfiltered);
}

void Placer::place(std::span<const std::uint32_t> kernels, std::uint32_t group, const Tiles& tiles,
                   Piece& piece) const {
  const std::size_t whole = takes_lanes_ ? kernels.size() / kLanes * kLanes : 0;
  place_lanes(kernels.first(whole), group, tiles, piece);
  place_each(kernels.subspan(whole), group, tiles, piece);
}

void Placer::place_each(std::span<const std::uint32_t> kernels, std::uint32_t group,
                        const Tiles& tiles, Piece& piece) const {
  const auto width = static_cast<float>(frame_.view.width);
  const auto height = static_cast<float>(frame_.view.height);
  for (const std::uint32_t k : kernels) {
    const FootprintRule& rule = frame_.footprints[frame_.cloud.part_of(k)];
    const auto footprint = in_camera_ ? footprint_of(frame_.cloud, k, camera_, rule, *in_camera_)
                                      : footprint_of(frame_.cloud, k, camera_, rule);
    if (!footprint) continue;
    const auto all = [](double value) RELIEF_INLINED { return all_of(static_cast<float>(value)); };
    const Shapes shapes{.x = all(footprint->centre.x),
                        .y = all(frame_.view.height - footprint->centre.y),
                        .xx = all(-kHalfLog2E * footprint->xx),
                        .xy = all(2.0 * kHalfLog2E * footprint->xy),
                        .yy = all(-kHalfLog2E * footprint->yy),
                        .reach_x = all(footprint->reach.x),
                        .reach_y = all(footprint->reach.y),
                        .peak = all(footprint->peak),
                        .cutoff = all(footprint->cutoff)};
    const Boxes boxes = boxes_of(shapes, width, height);
    const Box box = boxes.of(0);
    if (box.is_empty() || !tiles.is_open(box)) continue;
    const glm::vec3 colour = frame_.colour(k);
    const Vectors colours{all_of(colour.r), all_of(colour.g), all_of(colour.b)};
    piece.add(splat_of(shapes, factors_of(shapes), boxes, colours, group, 0));
  }
}

/// As footprint_of() (renderer/volume/splats/footprint.h).
RELIEF_FOR_EACH_CPU void Placer::place_lanes(std::span<const std::uint32_t> kernels,
                                             std::uint32_t group, const Tiles& tiles,
                                             Piece& piece) const {
  if (kernels.empty()) return;
  const KernelCloud& cloud = frame_.cloud;
  const FootprintRule& rule = frame_.footprints.front();
  const bool orthographic = camera_.orthographic;
  const FloatVariance v(*in_camera_);
  const glm::mat3 rotation(camera_.rotation);
  const glm::vec2 scale(camera_.scale);
  const glm::vec2 middle(camera_.middle);
  const auto width = static_cast<float>(frame_.view.width);
  const auto height = static_cast<float>(frame_.view.height);
  const float near = orthographic ? 0.0F : std::sqrt(std::max(v.zz, 0.0F));
  const auto filter = static_cast<float>(rule.filter == VolumeFilter::Ewa ? kLowPassVariance : 0.0);
  const auto cutoff = static_cast<float>(rule.cutoff);
  const auto per_area =
      static_cast<float>(1.0 / (2.0 * std::numbers::pi * (1.0 - std::exp(-0.5 * rule.cutoff))));
  for (; !kernels.empty(); kernels = kernels.subspan(kLanes)) {
    Vectors from_eye;
    Floats weight;
    for (int i = 0; i < kLanes; ++i) {
      const std::uint32_t k = kernels[static_cast<std::size_t>(i)];
      const glm::vec3 p(cloud.centres[k] - camera_.eye);
      from_eye.x[i] = p.x;
      from_eye.y[i] = p.y;
      from_eye.z[i] = p.z;
      weight[i] = cloud.weights[k];
    }
    const auto turned = [&](glm::length_t row) RELIEF_INLINED {
      return rotation[0][row] * from_eye.x + rotation[1][row] * from_eye.y +
             rotation[2][row] * from_eye.z;
    };
    const Floats tx = turned(0);
    const Floats ty = turned(1);
    const Floats tz = turned(2);
    const Floats per_depth = orthographic ? all_of(1.0F) : 1.0F / tz;
    const Floats x = orthographic ? Floats{} : tx * per_depth;
    const Floats y = orthographic ? Floats{} : ty * per_depth;
    const Floats a = scale.x * per_depth;
    const Floats b = scale.y * per_depth;
    const Floats x_depth = v.xz - x * v.zz;
    const Floats y_depth = v.yz - y * v.zz;
    const Floats xx = a * a * (v.xx - x * v.xz - x * x_depth) + filter;
    const Floats xy = a * b * (v.xy - x * v.yz - y * x_depth);
    const Floats yy = b * b * (v.yy - y * v.yz - y * y_depth) + filter;
    const Floats determinant = xx * yy - xy * xy;
    const Floats per_determinant = 1.0F / determinant;
    const Floats area = a * b * root_of(1.0F + x * x + y * y);
    const Shapes shapes{.x = middle.x + a * tx,
                        .y = height - middle.y - b * ty,
                        .xx = -kHalfLog2E * yy * per_determinant,
                        .xy = -2.0F * kHalfLog2E * xy * per_determinant,
                        .yy = -kHalfLog2E * xx * per_determinant,
                        .reach_x = root_of(cutoff * xx),
                        .reach_y = root_of(cutoff * yy),
                        .peak = weight * area * per_area * root_of(per_determinant),
                        .cutoff = all_of(cutoff)};
    const Boxes boxes = boxes_of(shapes, width, height);
    Ints is_seen = (tz > near) & (determinant > 0.0F) & (boxes.left <= boxes.right) &
                   (boxes.top <= boxes.bottom) & (shapes.peak - shapes.peak == 0.0F);
    bool is_any_seen = false;
    for (int i = 0; i < kLanes; ++i) {
      is_seen[i] = is_seen[i] != 0 && tiles.is_open(boxes.of(i)) ? 1 : 0;
      is_any_seen = is_any_seen || is_seen[i] != 0;
    }
    if (!is_any_seen) continue;
    const Factors factors = factors_of(shapes);
    const Vectors colours = colours_of(kernels, from_eye, is_seen);
    for (int i = 0; i < kLanes; ++i) {
      if (is_seen[i] != 0) piece.add(splat_of(shapes, factors, boxes, colours, group, i));
    }
  }
}

inline Vectors Placer::colours_of(std::span<const std::uint32_t> kernels, const Vectors& from_eye,
                                  const Ints& is_seen) const {
  const KernelCloud& cloud = frame_.cloud;
  if (frame_.distant_lights == nullptr) {
    Vectors colours{};
    for (int i = 0; i < kLanes; ++i) {
      if (is_seen[i] == 0) continue;
      const glm::vec3 colour = frame_.colour(kernels[static_cast<std::size_t>(i)]);
      colours.x[i] = colour.x;
      colours.y[i] = colour.y;
      colours.z[i] = colour.z;
    }
    return colours;
  }
  const Lighting& lighting = *frame_.distant_lights;
  const auto axis = [&](glm::length_t i) RELIEF_INLINED {
    return all_of(static_cast<float>(camera_.rotation[i].z));
  };
  const Floats per_distance = 1.0F / root_of(dot(from_eye, from_eye));
  const Vectors ray = camera_.orthographic
                          ? Vectors{axis(0), axis(1), axis(2)}
                          : Vectors{from_eye.x * per_distance, from_eye.y * per_distance,
                                    from_eye.z * per_distance};
  return lit(lighting.frame, lighting.lights, gathered(cloud.colours, kernels),
             gathered(cloud.normals, kernels), ray);
}

}  // namespace relief::volume::cpu
