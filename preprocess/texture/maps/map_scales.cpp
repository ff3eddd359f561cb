#include "preprocess/texture/maps/map_scales.h"

#include <algorithm>
#include <cmath>

#include "common/cross.h"

namespace relief {
namespace {

/// A power of two that is too small by this factor suffices: twice as many texels a side show no
/// more.
constexpr double kEnough = 1.12;
/// Triangles steeper than this (a cosine) belong to another patch.
constexpr double kSteepest = 0.26;
constexpr std::uint64_t kMaxTexelsUnasked = std::uint64_t{1} << 26U;
constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 30U;

/// Returns twice the area of a triangle in its image, texels.
double image_area(const Points& mesh, std::uint32_t triangle, glm::dvec2 size) {
  if (size.x == 0.0) return 0.0;
  const CornerTexcoords at = texcoords_of(mesh, triangle);
  const glm::dvec2 b = size * glm::dvec2(at[1] - at[0]);
  const glm::dvec2 c = size * glm::dvec2(at[2] - at[0]);
  return std::abs(cross(b, c));
}

/// Twice the area of triangles, in texels of their images and in cells of a patch.
struct Areas {
  double texels = 0.0;
  double cells = 0.0;
};

Areas areas_of(const Points& mesh, const std::vector<FlatTriangle>& triangles,
               const TextureSize& size_of) {
  Areas areas;
  for (const FlatTriangle& t : triangles) {
    if (t.twice_area < kSteepest * t.twice_area_in_space()) continue;
    areas.texels += image_area(mesh, t.index, size_of(t.index));
    areas.cells += t.twice_area;
  }
  return areas;
}

/// Returns the power of two of texels per cell that keeps the images' resolution.
std::uint32_t scale_for(const Areas& areas) {
  if (!(areas.texels > 0.0) || !std::isfinite(areas.texels)) return 1;
  const double along_side = std::sqrt(areas.texels / areas.cells) / kEnough;
  std::uint32_t scale = 1;
  while (scale < along_side && scale < kMaxTexelsPerCell) scale *= 2;
  return scale;
}

std::uint64_t count_texels(const std::vector<Patch>& patches,
                           const std::vector<std::uint32_t>& scales) {
  std::uint64_t sum = 0;
  for (std::size_t p = 0; p < patches.size(); ++p)
    sum += map_side(patches[p].width, scales[p]) * map_side(patches[p].height, scales[p]);
  return sum;
}

/// Largest side that patch files hold, with room for gutters beside the map.
bool fits(const Patch& patch, std::uint32_t scale) {
  return map_side(std::max(patch.width, patch.height) + 8, scale) <= kMaxPatchSide;
}

/// A scale for each patch. Gutters and mip levels are those of the finest map, so that no map is
/// more than twice as fine as needed.
std::vector<std::uint32_t> choose_scales(const Points& mesh,
                                         const std::vector<std::vector<FlatTriangle>>& triangles,
                                         const TextureSize& size_of) {
  Areas all;
  std::vector<std::uint32_t> scales;
  for (const std::vector<FlatTriangle>& own : triangles) {
    const Areas areas = areas_of(mesh, own, size_of);
    all.texels += areas.texels;
    all.cells += areas.cells;
    scales.push_back(scale_for(areas));
  }
  const std::uint32_t limit = 2 * scale_for(all);
  for (std::uint32_t& scale : scales) scale = std::min(scale, limit);
  return scales;
}

/// All maps become coarser until they fit.
void limit_scales(const std::vector<Patch>& patches, std::vector<std::uint32_t>& scales) {
  for (std::size_t p = 0; p < patches.size(); ++p) {
    while (scales[p] > 1 && !fits(patches[p], scales[p])) scales[p] /= 2;
  }
  while (count_texels(patches, scales) > kMaxTexelsUnasked) {
    const std::uint32_t largest = *std::max_element(scales.begin(), scales.end());
    if (largest == 1) return;
    for (std::uint32_t& scale : scales) scale = std::min(scale, largest / 2);
  }
}

Status check_scales(const std::vector<Patch>& patches, const std::vector<std::uint32_t>& scales) {
  const bool all_fit = std::all_of(patches.begin(), patches.end(),
                                   [&](const Patch& patch) { return fits(patch, scales.front()); });
  const std::uint64_t texels = count_texels(patches, scales);
  if (all_fit && texels <= kMaxTexels) return {};
  return make_error("{} texels a cell would make {} texels, {}; choose fewer", scales.front(),
                    texels, all_fit ? "more than memory is meant for" : "more than a patch holds");
}

}  // namespace

Result<std::vector<std::uint32_t>> scales_of_maps(
    const Points& mesh, const std::vector<Patch>& patches,
    const std::vector<std::vector<FlatTriangle>>& triangles, const TextureSize& size_of,
    std::uint32_t texels_per_cell) {
  std::vector<std::uint32_t> scales(patches.size(), texels_per_cell);
  if (texels_per_cell == 0) {
    scales = choose_scales(mesh, triangles, size_of);
    limit_scales(patches, scales);
  } else if (const Status ok = check_scales(patches, scales); !ok) {
    return ok.error();
  }
  return scales;
}

}  // namespace relief
