#include "preprocess/texture/texture_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "common/continuation.h"
#include "common/mesh_texture.h"
#include "common/patch_codec.h"
#include "common/srgb.h"
#include "preprocess/texture/flat_triangles.h"

namespace relief {
namespace {

/// How much nearer a triangle must be that faces away, cells: the back of a thin sheet has texels
/// of its own.
constexpr double kFacingAway = 3.0;
/// Weights this far below 0 still count, so that no texel falls between two triangles.
constexpr double kOnEdge = -1e-9;
/// A power of two that is this much too small is good enough: twice as many texels a side show no
/// more.
constexpr double kEnough = 1.12;
/// Triangles steeper than this (a cosine) are some other patch's to show.
constexpr double kSteepest = 0.26;
constexpr std::uint64_t kMostTexelsUnasked = std::uint64_t{1} << 26U;
constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 30U;
/// Linear, what patches without colours are drawn in.
constexpr float kNeutralGrey = 0.5F;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Twice the area that a triangle has in its texture, texels.
double texture_area(const Points& mesh, std::uint32_t triangle) {
  const std::uint32_t material = mesh.triangle_materials[triangle];
  if (material == kNoMaterial || mesh.materials[material].texture == nullptr) return 0.0;
  const MeshTexture& texture = *mesh.materials[material].texture;
  const CornerTexcoords at = texcoords_of(mesh, triangle);
  const glm::dvec2 size(texture.width(), texture.height());
  const glm::dvec2 b = size * glm::dvec2(at[1] - at[0]);
  const glm::dvec2 c = size * glm::dvec2(at[2] - at[0]);
  return std::abs(b.x * c.y - b.y * c.x);
}

/// Twice the area of triangles, in texels of their textures and in cells of a patch.
struct Areas {
  double texels = 0.0;
  double cells = 0.0;
};

Areas areas_of(const Points& mesh, const std::vector<FlatTriangle>& triangles) {
  Areas areas;
  for (const FlatTriangle& t : triangles) {
    if (t.twice_area < kSteepest * t.twice_area_in_space()) continue;
    areas.texels += texture_area(mesh, t.index);
    areas.cells += t.twice_area;
  }
  return areas;
}

/// The power of two of texels a cell that holds what the textures hold.
std::uint32_t scale_for(const Areas& areas) {
  if (!(areas.texels > 0.0) || !std::isfinite(areas.texels)) return 1;
  const double along_side = std::sqrt(areas.texels / areas.cells) / kEnough;
  std::uint32_t scale = 1;
  while (scale < along_side && scale < kMostTexelsPerCell) scale *= 2;
  return scale;
}

std::uint64_t side_of(std::uint32_t nodes, std::uint32_t scale) {
  return std::uint64_t{scale} * (nodes - 1) + 1;
}

std::uint64_t count_texels(const std::vector<Patch>& patches,
                           const std::vector<std::uint32_t>& scales) {
  std::uint64_t sum = 0;
  for (std::size_t p = 0; p < patches.size(); ++p)
    sum += side_of(patches[p].width, scales[p]) * side_of(patches[p].height, scales[p]);
  return sum;
}

/// Sides that patch files hold, with room for gutters beside the map.
bool fits(const Patch& patch, std::uint32_t scale) {
  return side_of(std::max(patch.width, patch.height) + 8, scale) <= kMaxPatchSide;
}

/// A scale for each patch. Gutters and mip levels are those of the finest map, so that none is more
/// than twice as fine as all together need.
std::vector<std::uint32_t> choose_scales(const Points& mesh,
                                         const std::vector<std::vector<FlatTriangle>>& triangles) {
  Areas all;
  std::vector<std::uint32_t> scales;
  for (const std::vector<FlatTriangle>& own : triangles) {
    const Areas areas = areas_of(mesh, own);
    all.texels += areas.texels;
    all.cells += areas.cells;
    scales.push_back(scale_for(areas));
  }
  const std::uint32_t most = 2 * scale_for(all);
  for (std::uint32_t& scale : scales) scale = std::min(scale, most);
  return scales;
}

/// Coarser everywhere until it is not too much.
void limit_scales(const std::vector<Patch>& patches, std::vector<std::uint32_t>& scales) {
  for (std::size_t p = 0; p < patches.size(); ++p) {
    while (scales[p] > 1 && !fits(patches[p], scales[p])) scales[p] /= 2;
  }
  while (count_texels(patches, scales) > kMostTexelsUnasked) {
    const std::uint32_t largest = *std::max_element(scales.begin(), scales.end());
    if (largest == 1) return;
    for (std::uint32_t& scale : scales) scale = std::min(scale, largest / 2);
  }
}

Status check_scales(const std::vector<Patch>& patches, const std::vector<std::uint32_t>& scales) {
  const bool all_fit = std::all_of(patches.begin(), patches.end(),
                                   [&](const Patch& patch) { return fits(patch, scales.front()); });
  const std::uint64_t texels = count_texels(patches, scales);
  if (all_fit && texels <= kMostTexels) return {};
  return make_error("{} texels a cell would make {} texels, {}; choose fewer", scales.front(),
                    texels, all_fit ? "more than memory is meant for" : "more than a patch holds");
}

/// The patch's surface, cells, continued over holes.
class Surface {
 public:
  explicit Surface(const Patch& patch) : in_cells_(patch.height_step / patch.spacing) {
    heights_.width = patch.width;
    heights_.height = patch.height;
    std::vector<std::uint8_t> kept;
    for (const std::int32_t h : patch.heights) {
      kept.push_back(h != kHole ? 1 : 0);
      heights_.texels.emplace_back(h != kHole ? h : 0);
    }
    continue_over_holes(heights_, kept);
  }

  [[nodiscard]] double at(glm::dvec2 place) const {
    const auto i = static_cast<std::uint32_t>(place.x);
    const auto j = static_cast<std::uint32_t>(place.y);
    const double x = place.x - i;
    const double y = place.y - j;
    return in_cells_ * ((1.0 - y) * ((1.0 - x) * node(i, j) + x * node(i + 1, j)) +
                        y * ((1.0 - x) * node(i, j + 1) + x * node(i + 1, j + 1)));
  }

 private:
  [[nodiscard]] double node(std::uint32_t i, std::uint32_t j) const {
    const std::size_t row = std::size_t{std::min(j, heights_.height - 1)} * heights_.width;
    return heights_.texels[row + std::min(i, heights_.width - 1)].x;
  }

  AttributeMap<glm::vec<1, std::int32_t>> heights_;
  double in_cells_;
};

/// For each texel which of the triangles it shows, or kNone.
std::vector<std::uint32_t> find_shown(const Patch& patch, const AttributeMap<glm::u8vec3>& map,
                                      const std::vector<FlatTriangle>& triangles) {
  const Surface surface(patch);
  std::vector<std::uint32_t> shown(std::size_t{map.width} * map.height, kNone);
  std::vector<float> least(shown.size(), std::numeric_limits<float>::infinity());
  const double scale = map.scale;
  const auto first = [scale](double low) {
    return static_cast<std::uint32_t>(std::max(0.0, std::ceil(low * scale - 1e-6)));
  };
  const auto last = [scale](double high, std::uint32_t side) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(high * scale + 1e-6) + 1.0, 0.0, static_cast<double>(side)));
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const FlatTriangle& triangle = triangles[t];
    const auto& p = triangle.corners;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const double penalty = triangle.twice_area > 0.0 ? 0.0 : kFacingAway;
    for (std::uint32_t b = first(low); b < last(high, map.height); ++b) {
      for (std::uint32_t a = first(left); a < last(right, map.width); ++a) {
        const glm::dvec2 place(a / scale, b / scale);
        const glm::dvec3 weights = triangle.weights_at(place);
        if (std::min({weights.x, weights.y, weights.z}) < kOnEdge) continue;
        const double away = std::abs(glm::dot(weights, triangle.heights) - surface.at(place));
        const auto cost = static_cast<float>(away + penalty);
        const std::size_t k = std::size_t{b} * map.width + a;
        if (away > kTexelReach || !(cost < least[k])) continue;
        least[k] = cost;
        shown[k] = t;
      }
    }
  }
  return shown;
}

/// What a triangle shows, as a function of the place on the base plane.
class TriangleColour {
 public:
  TriangleColour(const Points& mesh, const FlatTriangle& triangle, double scale)
      : triangle_(&triangle) {
    const std::uint32_t material = mesh.triangle_materials[triangle.index];
    if (material == kNoMaterial) return;
    colour_ = mesh.materials[material].colour;
    texture_ = mesh.materials[material].texture.get();
    if (texture_ == nullptr) return;
    texcoords_ = texcoords_of(mesh, triangle.index);
    // Weights are linear in the place: a texel's step is the same everywhere.
    const glm::dvec2 here = texcoord_at({0.0, 0.0});
    du_ = glm::vec2(texcoord_at({1.0 / scale, 0.0}) - here);
    dv_ = glm::vec2(texcoord_at({0.0, 1.0 / scale}) - here);
  }

  [[nodiscard]] glm::vec3 at(glm::dvec2 place) const {
    return texture_ == nullptr ? colour_ : colour_ * texture_->mean(texcoord_at(place), du_, dv_);
  }

 private:
  [[nodiscard]] glm::dvec2 texcoord_at(glm::dvec2 place) const {
    const glm::dvec3 w = triangle_->weights_at(place);
    return w.x * glm::dvec2(texcoords_[0]) + w.y * glm::dvec2(texcoords_[1]) +
           w.z * glm::dvec2(texcoords_[2]);
  }

  const FlatTriangle* triangle_;
  glm::vec3 colour_{kNeutralGrey};
  const MeshTexture* texture_ = nullptr;
  CornerTexcoords texcoords_{};
  glm::vec2 du_{0.0F};
  glm::vec2 dv_{0.0F};
};

AttributeMap<glm::u8vec3> make_map(const Points& mesh, const Patch& patch,
                                   const std::vector<FlatTriangle>& triangles,
                                   std::uint32_t scale) {
  AttributeMap<glm::u8vec3> map{static_cast<std::uint32_t>(side_of(patch.width, scale)),
                                static_cast<std::uint32_t>(side_of(patch.height, scale)),
                                scale,
                                {}};
  map.texels.resize(std::size_t{map.width} * map.height,
                    glm::u8vec3(srgb8_from_linear(kNeutralGrey)));
  const std::vector<std::uint32_t> shown = find_shown(patch, map, triangles);
  std::vector<TriangleColour> colours;
  colours.reserve(triangles.size());
  for (const FlatTriangle& triangle : triangles) colours.emplace_back(mesh, triangle, scale);
  // What a patch file keeps: the rest is made anew when it is read, and is the same here.
  std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (shown[k] == kNone) kept[k] = 0;
    if (kept[k] == 0) continue;
    const std::size_t column = k % map.width;
    const std::size_t row = k / map.width;
    const glm::dvec2 place = glm::dvec2(column, row) / static_cast<double>(scale);
    map.texels[k] = srgb8_from_linear(colours[shown[k]].at(place));
  }
  continue_over_holes(map, kept);
  return map;
}

}  // namespace

Status map_textures(const Points& mesh, std::uint32_t texels_per_cell, std::vector<Patch>& patches,
                    Progress& progress) {
  if (patches.empty()) return {};
  progress.begin_stage("textures", patches.size());
  const TriangleSpheres spheres(mesh);
  std::vector<std::vector<FlatTriangle>> triangles(patches.size());
  std::vector<std::uint32_t> scales(patches.size(), texels_per_cell);
  tbb::parallel_for(std::size_t{0}, patches.size(),
                    [&](std::size_t p) { triangles[p] = spheres.find_over(patches[p]); });
  if (texels_per_cell == 0) {
    scales = choose_scales(mesh, triangles);
    limit_scales(patches, scales);
  } else if (const Status ok = check_scales(patches, scales); !ok) {
    return ok.error();
  }
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    patches[p].colours = make_map(mesh, patches[p], triangles[p], scales[p]);
    progress.advance(1);
  });
  if (progress.cancelled()) return interrupted_error();
  return {};
}

}  // namespace relief
