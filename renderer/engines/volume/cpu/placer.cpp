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

/// The factors by which weights change, and the boxes.
std::array<Splat, kLanes> splats_of(const Shapes& shapes, float width, float height) {
  const Floats x = shapes.reach_x + kLanes;  // runs begin up to kLanes pixels before the box
  const Floats y = shapes.reach_y + 1.0F;
  const Floats slant = larger(shapes.xy, -shapes.xy);
  const Floats lowest = shapes.xx * x * x - slant * x * y + shapes.yy * y * y;
  const auto factor = [](const Floats& e) RELIEF_INLINED {
    return exp2_of(smaller(larger(e, all_of(kLeastExponent)), all_of(-kLeastExponent)));
  };
  const Floats least = factor(-kHalfLog2E * shapes.cutoff);
  const Floats down = factor(2.0F * shapes.yy);
  const Floats right = factor(2.0F * kLanes * kLanes * shapes.xx);
  const Floats slanted = factor(kLanes * shapes.xy);
  // Rounded up from the lower ends and down from the upper ones, within the image.
  const auto end = [](const Floats& at, float size) RELIEF_INLINED {
    const Floats within = smaller(larger(at + 0.5F, all_of(0.0F)), all_of(size));
    return __builtin_convertvector(within, Ints);
  };
  const Ints lefts = end(shapes.x - shapes.reach_x, width);
  const Ints rights = end(shapes.x + shapes.reach_x, width) - 1;
  const Ints tops = end(shapes.y - shapes.reach_y, height);
  const Ints bottoms = end(shapes.y + shapes.reach_y, height) - 1;
  std::array<Splat, kLanes> splats;
  for (int i = 0; i < kLanes; ++i) {
    Splat& splat = splats[static_cast<std::size_t>(i)];
    splat.x = shapes.x[i];
    splat.y = shapes.y[i];
    splat.xx = shapes.xx[i];
    splat.xy = shapes.xy[i];
    splat.yy = shapes.yy[i];
    splat.peak = shapes.peak[i];
    splat.least = least[i];
    splat.down = down[i];
    splat.right = right[i];
    splat.slanted = slanted[i];
    splat.is_steep = !(lowest[i] > -kSteep);
    splat.box = {lefts[i], rights[i], tops[i], bottoms[i]};
  }
  return splats;
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
                   std::vector<Splat>& splats) const {
  const std::size_t whole = takes_lanes_ ? kernels.size() / kLanes * kLanes : 0;
  place_lanes(kernels.first(whole), group, tiles, splats);
  place_each(kernels.subspan(whole), group, tiles, splats);
}

void Placer::place_each(std::span<const std::uint32_t> kernels, std::uint32_t group,
                        const Tiles& tiles, std::vector<Splat>& splats) const {
  const auto height = static_cast<double>(frame_.view.height);
  for (const std::uint32_t k : kernels) {
    const FootprintRule& rule = frame_.footprints[frame_.cloud.part_of(k)];
    const auto footprint = in_camera_ ? footprint_of(frame_.cloud, k, camera_, rule, *in_camera_)
                                      : footprint_of(frame_.cloud, k, camera_, rule);
    if (!footprint) continue;
    const auto all = [](double value) RELIEF_INLINED { return all_of(static_cast<float>(value)); };
    const Shapes shapes{.x = all(footprint->centre.x),
                        .y = all(height - footprint->centre.y),
                        .xx = all(-kHalfLog2E * footprint->xx),
                        .xy = all(2.0 * kHalfLog2E * footprint->xy),
                        .yy = all(-kHalfLog2E * footprint->yy),
                        .reach_x = all(footprint->reach.x),
                        .reach_y = all(footprint->reach.y),
                        .peak = all(footprint->peak),
                        .cutoff = all(footprint->cutoff)};
    const auto width = static_cast<float>(frame_.view.width);
    append(splats_of(shapes, width, static_cast<float>(height)).front(), k, group, tiles, splats);
  }
}

/// As footprint_of() (renderer/volume/splats/footprint.h).
void Placer::place_lanes(std::span<const std::uint32_t> kernels, std::uint32_t group,
                         const Tiles& tiles, std::vector<Splat>& splats) const {
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
  for (std::size_t first = 0; first < kernels.size(); first += kLanes) {
    Floats px, py, pz, weight;
    for (int i = 0; i < kLanes; ++i) {
      const std::uint32_t k = kernels[first + static_cast<std::size_t>(i)];
      const glm::vec3 p(cloud.centres[k] - camera_.eye);
      px[i] = p.x;
      py[i] = p.y;
      pz[i] = p.z;
      weight[i] = cloud.weights[k];
    }
    const auto turned = [&](glm::length_t row) RELIEF_INLINED {
      return rotation[0][row] * px + rotation[1][row] * py + rotation[2][row] * pz;
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
    const std::array<Splat, kLanes> placed = splats_of(shapes, width, height);
    for (int i = 0; i < kLanes; ++i) {
      const Splat& splat = placed[static_cast<std::size_t>(i)];
      if (tz[i] > near && determinant[i] > 0.0F && std::isfinite(splat.peak))
        append(splat, kernels[first + static_cast<std::size_t>(i)], group, tiles, splats);
    }
  }
}

void Placer::append(Splat splat, std::uint32_t kernel, std::uint32_t group, const Tiles& tiles,
                    std::vector<Splat>& splats) const {
  if (splat.box.is_empty() || !tiles.is_open(splat.box)) return;
  const glm::vec3 colour = frame_.colour(kernel);
  splat.red = colour.r;
  splat.green = colour.g;
  splat.blue = colour.b;
  splat.group = group;
  splats.push_back(splat);
}

}  // namespace relief::volume::cpu
