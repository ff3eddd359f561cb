#include "viewer/measuring/corrected_hit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Half a cell: of the two triangles, `lower` lies below the diagonal from (0, 0) to (1, 1).
struct HalfCell {
  glm::ivec2 cell{0};
  bool lower = false;

  bool operator==(const HalfCell&) const = default;
};

/// A position against the triangle under it.
struct OverTriangle {
  bool exists = false;  ///< false: a corner is a hole
  double above = 0.0;   ///< height of the position over the triangle's plane, in cells
  glm::dvec2 slope{0.0};
};

/// The triangles of a patch, and a view ray.
class RayOverPatch {
 public:
  RayOverPatch(const Patch& patch, glm::dvec3 hit, glm::dvec3 ray)
      : patch_(&patch), hit_(hit), ray_(ray) {}

  /// How far along the ray a step of half a cell is.
  [[nodiscard]] double half_cell() const {
    return 0.5 / std::sqrt(std::max(glm::dot(glm::dvec2(ray_), glm::dvec2(ray_)), 1e-30));
  }

  [[nodiscard]] glm::dvec3 at(double along) const { return hit_ + along * ray_; }

  [[nodiscard]] HalfCell half_cell_under(double along) const {
    const glm::dvec2 position(at(along));
    const glm::dvec2 last = glm::max(nodes() - 2.0, glm::dvec2(0.0));
    const glm::dvec2 cell = glm::clamp(glm::floor(position), glm::dvec2(0.0), last);
    const glm::dvec2 inside = position - cell;
    return {glm::ivec2(cell), inside.x > inside.y};
  }

  [[nodiscard]] OverTriangle over_triangle(double along) const {
    const HalfCell half = half_cell_under(along);
    const glm::dvec3 position = at(along);
    const double a = height(half.cell);
    const double b = height(half.cell + (half.lower ? glm::ivec2(1, 0) : glm::ivec2(0, 1)));
    const double c = height(half.cell + 1);
    OverTriangle over;
    over.exists = std::isfinite(a + b + c);
    over.slope = half.lower ? glm::dvec2(b - a, c - b) : glm::dvec2(c - b, b - a);
    const glm::dvec2 inside = glm::dvec2(position) - glm::dvec2(half.cell);
    over.above = position.z - (a + glm::dot(over.slope, inside));
    return over;
  }

  /// Height over the surface on the eye's side; nothing beside the patch and over holes.
  [[nodiscard]] std::optional<double> outside(double along, const OverTriangle& over) const {
    const glm::dvec2 position(at(along));
    const bool within = position.x > -0.5 && position.y > -0.5 && position.x < nodes().x - 0.5 &&
                        position.y < nodes().y - 0.5;
    if (!within || !over.exists) return std::nullopt;
    return ray_.z < 0.0 ? over.above : -over.above;
  }

  /// How much farther along the ray it meets the plane of the triangle under a position.
  [[nodiscard]] double to_plane(const OverTriangle& over) const {
    return over.above / (glm::dot(over.slope, glm::dvec2(ray_)) - ray_.z);
  }

 private:
  [[nodiscard]] glm::dvec2 nodes() const { return {patch_->width, patch_->height}; }

  /// In cells; infinite at holes and beyond the patch.
  [[nodiscard]] double height(glm::ivec2 node) const {
    const glm::uvec2 n(node);
    const std::int32_t index =
        n.x < patch_->width && n.y < patch_->height ? patch_->at(n.x, n.y) : kHole;
    if (index == kHole) return std::numeric_limits<double>::infinity();
    return index * (patch_->height_step / patch_->spacing);
  }

  const Patch* patch_;
  glm::dvec3 hit_;
  glm::dvec3 ray_;
};

/// Searches for the surface by half cells to both sides: where the ray first goes through it, else
/// where it passes nearest, if that is near enough.
std::optional<double> search(const RayOverPatch& ray) {
  std::optional<double> found;
  std::optional<double> before;
  double nearest = shared::kLargestMiss;
  for (int step = -shared::kSearchSteps; step <= shared::kSearchSteps; ++step) {
    const double along = step * ray.half_cell();
    const OverTriangle over = ray.over_triangle(along);
    const std::optional<double> outside = ray.outside(along, over);
    if (before && *before >= 0.0 && outside && *outside < 0.0)
      return along - ray.half_cell() * *outside / (*outside - *before);
    before = outside;
    if (!outside) continue;
    const double miss = std::abs(*outside) / std::sqrt(1.0 + glm::dot(over.slope, over.slope));
    if (miss > nearest) continue;
    nearest = miss;
    found = along;
  }
  return found;
}

}  // namespace

std::optional<glm::dvec3> corrected_hit(const Patch& patch, glm::dvec3 hit, glm::dvec3 direction) {
  const RayOverPatch ray(patch, hit, direction);
  double along = 0.0;
  for (const bool is_second : {false, true}) {
    const OverTriangle over = ray.over_triangle(along);
    if (!over.exists) return hit;
    const double next = along + ray.to_plane(over);
    const bool is_near = std::abs(next) <= ray.half_cell();  // not where both are 0
    if (is_near && ray.half_cell_under(next) == ray.half_cell_under(along)) return ray.at(next);
    if (is_second && std::abs(over.above) < shared::kOnSurface) return ray.at(along);
    if (!is_near) break;
    along = next;
  }
  if (const auto found = search(ray)) return ray.at(*found);
  return std::nullopt;
}

}  // namespace relief
