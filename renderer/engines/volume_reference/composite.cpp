#include "renderer/engines/volume_reference/composite.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/engines/volume_reference/footprint_rows.h"
#include "renderer/volume/splats/share_before.h"

namespace relief::volume_reference {
namespace {

/// The share of a kernel that lies in its group's slab and before `limit`, seen at a place in the
/// image.
double share_in_slab(const Footprint& footprint, glm::dvec2 from_centre, std::uint32_t group,
                     const SplatOrder& order, double limit) {
  const double low = order.first_depth + order.thickness * group;
  const double high = std::min(low + order.thickness, limit);
  if (!(high > low)) return 0.0;
  return share_before(footprint, from_centre, high) - share_before(footprint, from_centre, low);
}

PixelBox united(const PixelBox& a, const PixelBox& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
          std::max(a.bottom, b.bottom)};
}

/// Composites one tile.
class TileCompositor {
 public:
  TileCompositor(const Composition& composition, TileLayers& layers, TilePixels& pixels)
      : composition_(composition), layers_(layers), pixels_(pixels) {}

  /// Adds a splat to its group's layer.
  void add(const OrderedSplat& entry) {
    const PlacedSplat& placed = composition_.splats[entry.splat];
    const Footprint& footprint = placed.footprint;
    const glm::dvec3 colour(composition_.colours[entry.splat]);
    const FootprintRows rows(footprint, composition_.height);
    const PixelBox part = pixels_of(footprint, composition_.height, pixels_.box());
    touched_ = united(touched_, part);
    for (std::int64_t y = part.top; y <= part.bottom; ++y) {
      rows.row(y, part.left, part.right, row_);
      if (row_.first > row_.last) continue;
      const auto count = static_cast<std::size_t>(row_.last - row_.first + 1);
      evaluations_ += count;
      const std::span<double> weights(row_.weights.data(), count);
      apply_alphas(weights);
      const std::size_t first = pixels_.index(row_.first, y);
      if (composition_.order.has_slabs || !pixels_.limits().empty()) {
        for (std::size_t i = 0; i < count; ++i) {
          const auto at = rows.from_centre(row_.first + static_cast<std::int64_t>(i), y);
          weights[i] = kept_of(weights[i], footprint, at, entry.group, first + i);
        }
      }
      layers_.add_row(first, weights, colour);
      if (!composition_.normals.empty()) {
        const glm::dvec3 normal(composition_.normals[placed.kernel]);
        for (std::size_t i = 0; i < count; ++i) layers_.add_normal(first + i, weights[i] * normal);
      }
      if (composition_.has_depth) {
        double depth = footprint.depth + glm::dot(footprint.slope, rows.from_centre(row_.first, y));
        for (std::size_t i = 0; i < count; ++i, depth += footprint.slope.x)
          layers_.add_place(first + i, weights[i] * depth);
      }
    }
  }

  /// Puts the layer behind what the pixels show.
  void end_group() {
    for (std::int64_t y = touched_.top; y <= touched_.bottom; ++y) {
      for (std::int64_t x = touched_.left; x <= touched_.right; ++x) {
        const std::size_t pixel = pixels_.index(x, y);
        pixels_.put_behind(pixel, layers_.take(pixel), composition_.rule);
      }
    }
    touched_ = {};
  }

  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// What of a weight lies in the group's slab, if there are slabs, and before the pixel's limit.
  [[nodiscard]] double kept_of(double weight, const Footprint& footprint, glm::dvec2 from_centre,
                               std::uint32_t group, std::size_t pixel) const {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const double limit = pixels_.limits().empty() ? kNowhere : pixels_.limits()[pixel];
    if (composition_.order.has_slabs)
      return weight * share_in_slab(footprint, from_centre, group, composition_.order, limit);
    if (!(limit < kNowhere)) return weight;
    return weight_before(weight, share_before(footprint, from_centre, limit),
                         composition_.rule.weight);
  }
  void apply_alphas(std::span<double> weights) const {
    const CompositeRule& rule = composition_.rule;
    if (rule.weight != KernelWeight::Peak) return;
    for (double& weight : weights)
      weight = weight < rule.min_alpha ? 0.0 : std::min(weight, rule.max_alpha);
  }

  const Composition& composition_;
  TileLayers& layers_;
  TilePixels& pixels_;
  RowWeights row_;
  PixelBox touched_;  ///< by the group
  std::uint64_t evaluations_ = 0;
};

}  // namespace

std::uint64_t composite_tile(const Composition& composition, std::span<const OrderedSplat> list,
                             TileLayers& layers, TilePixels& pixels) {
  TileCompositor compositor(composition, layers, pixels);
  for (std::size_t e = 0; e < list.size() && !pixels.is_all_done(); ++e) {
    compositor.add(list[e]);
    if (e + 1 == list.size() || list[e + 1].group != list[e].group) compositor.end_group();
  }
  return compositor.evaluations();
}

}  // namespace relief::volume_reference
