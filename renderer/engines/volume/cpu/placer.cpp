#include "renderer/engines/volume/cpu/placer.h"

#include <algorithm>

#include "renderer/engines/volume/cpu/shapes.h"

namespace relief::volume::cpu {
namespace {

glm::vec3 normal_of(const KernelCloud& cloud, std::size_t k) {
  return cloud.normals.empty() ? glm::vec3(0.0F) : cloud.normals[k];
}

SplatSurface surface_of(const Footprint& footprint, const glm::vec3& normal) {
  return {.depth = static_cast<float>(footprint.depth),
          .right = static_cast<float>(footprint.slope.x),
          .down = static_cast<float>(-footprint.slope.y),
          .per_deviation = static_cast<float>(
              1.0 / std::max<double>(footprint.depth_deviation, kLeastDeviation)),
          .normal = normal};
}

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
  if (cloud.starts.size() <= 1 && cloud.is_surface.empty() &&
      rule.weight == KernelWeight::Integral &&
      (rule.filter == VolumeFilter::Ewa || rule.filter == VolumeFilter::Unfiltered))
    grid_.emplace(camera_, frame.view, rule, *in_camera_);
}

void Placer::place(std::span<const std::uint32_t> kernels, std::uint32_t group, const Tiles& tiles,
                   Piece& piece) const {
  const std::size_t whole = grid_ ? kernels.size() / kLanes * kLanes : 0;
  if (whole > 0) place_lanes(*grid_, kernels.first(whole), group, tiles, piece);
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
    const Splat splat = splat_of(shapes, factors_of(shapes), boxes, colours, group, 0);
    if (piece.has_surfaces())
      piece.add(splat, surface_of(*footprint, normal_of(frame_.cloud, k)));
    else
      piece.add(splat);
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

RELIEF_FOR_EACH_CPU void Placer::place_lanes(const GridProjection& grid,
                                             std::span<const std::uint32_t> kernels,
                                             std::uint32_t group, const Tiles& tiles,
                                             Piece& piece) const {
  const KernelCloud& cloud = frame_.cloud;
  const auto width = static_cast<float>(frame_.view.width);
  const auto height = static_cast<float>(frame_.view.height);
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
    const auto projected = grid.project(from_eye, weight);
    const Boxes boxes = boxes_of(projected.shapes, width, height);
    Ints is_seen = projected.is_valid & (boxes.left <= boxes.right) & (boxes.top <= boxes.bottom);
    bool is_any_seen = false;
    for (int i = 0; i < kLanes; ++i) {
      is_seen[i] = is_seen[i] != 0 && tiles.is_open(boxes.of(i)) ? 1 : 0;
      is_any_seen = is_any_seen || is_seen[i] != 0;
    }
    if (!is_any_seen) continue;
    const Factors factors = factors_of(projected.shapes);
    const Vectors colours = colours_of(kernels, from_eye, is_seen);
    const auto splat_at = [&](int i) RELIEF_INLINED {
      return splat_of(projected.shapes, factors, boxes, colours, group, i);
    };
    if (!piece.has_surfaces()) {
      for (int i = 0; i < kLanes; ++i) {
        if (is_seen[i] != 0) piece.add(splat_at(i));
      }
      continue;
    }
    const auto depths = grid.depths_of(projected);
    for (int i = 0; i < kLanes; ++i) {
      if (is_seen[i] == 0) continue;
      piece.add(splat_at(i), {.depth = projected.depth[i],
                              .right = depths.right[i],
                              .down = -depths.up[i],
                              .per_deviation = depths.per_deviation[i],
                              .normal = normal_of(cloud, kernels[static_cast<std::size_t>(i)])});
    }
  }
}

}  // namespace relief::volume::cpu
