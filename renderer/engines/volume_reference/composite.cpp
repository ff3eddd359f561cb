#include "renderer/engines/volume_reference/composite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/volume/share_before.h"

namespace relief::volume_reference {
namespace {

/// What the splats of a group leave in a pixel, before it is composited.
struct Layer {
  double depth_sum = 0.0;  ///< optical depth, or opacity
  glm::dvec3 colour{0.0};  ///< times that
  glm::dvec3 normal{0.0};
  double place = 0.0;  ///< depth along the axis, times that
};

double normal_distribution(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// The share of a kernel that lies in its group's slab and before `limit`, seen at a place in the
/// image.
double share_in_slab(const Footprint& footprint, glm::dvec2 from_centre, std::uint32_t group,
                     const SplatOrder& order, double limit) {
  const double mean = footprint.depth + glm::dot(footprint.slope, from_centre);
  const double low = order.first_depth + order.thickness * group;
  const double high = std::min(low + order.thickness, limit);
  if (!(high > low)) return 0.0;
  if (!(footprint.depth_deviation > 0.0)) return mean >= low && mean < high ? 1.0 : 0.0;
  const auto below = [&](double depth) {
    return normal_distribution((depth - mean) / footprint.depth_deviation);
  };
  return below(high) - below(low);
}

/// Composites layers into a tile's pixels.
class TileCompositor {
 public:
  TileCompositor(const CompositeRule& rule, std::span<VolumePixel> pixels)
      : rule_(rule), pixels_(pixels) {}

  [[nodiscard]] Layer& layer(std::size_t pixel) { return layers_[pixel]; }
  [[nodiscard]] bool is_done(std::size_t pixel) const { return done_[pixel]; }
  void end(std::size_t pixel) {
    done_[pixel] = true;
    ++count_done_;
  }
  [[nodiscard]] bool is_all_done(std::size_t pixels) const { return count_done_ == pixels; }

  /// Puts what has been added to a layer behind what the pixel shows.
  void end_layer(std::size_t pixel) {
    Layer& layer = layers_[pixel];
    const double sum = layer.depth_sum;
    if (!(sum > 0.0) || done_[pixel]) {
      layer = {};
      return;
    }
    const double alpha = opacity_of(sum);
    VolumePixel& shown = pixels_[pixel];
    const double after = shown.transmittance * (1.0 - alpha);
    if (rule_.weight == KernelWeight::Peak && after < rule_.min_transmittance) {
      // As [Kerbl 2023] does: what would end a pixel is left out.
      end(pixel);
      layer = {};
      return;
    }
    const double share = shown.transmittance * alpha / sum;
    shown.colour += share * layer.colour;
    shown.normal += share * layer.normal;
    if (shown.transmittance > 0.5 && after <= 0.5) shown.depth = layer.place / sum;
    shown.transmittance = after;
    if (after < rule_.min_transmittance) end(pixel);
    layer = {};
  }

 private:
  [[nodiscard]] double opacity_of(double sum) const {
    const bool is_exponential =
        rule_.weight == KernelWeight::Integral && rule_.attenuation == Attenuation::Exponential;
    return std::min(is_exponential ? -std::expm1(-sum) : sum, rule_.max_alpha);
  }

  const CompositeRule& rule_;
  std::span<VolumePixel> pixels_;
  std::array<Layer, kTile * kTile> layers_{};
  std::array<bool, kTile * kTile> done_{};
  std::size_t count_done_ = 0;
};

}  // namespace

std::uint64_t composite_tile(const Composition& composition, const TileLists& lists,
                             std::size_t tile, std::span<const float> limits,
                             std::span<VolumePixel> pixels) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const PixelBox box = composition.tiling.box(tile);
  const auto height = static_cast<double>(composition.tiling.height);
  const auto in_tile =
      static_cast<std::size_t>((box.right - box.left + 1) * (box.bottom - box.top + 1));
  const CompositeRule& rule = composition.rule;
  TileCompositor compositor(rule, pixels);
  const auto pixel_at = [&](std::int64_t x, std::int64_t y) {
    return static_cast<std::size_t>((y - box.top) * kTile + (x - box.left));
  };
  const auto end_layers = [&](const PixelBox& part) {
    for (std::int64_t y = part.top; y <= part.bottom; ++y) {
      for (std::int64_t x = part.left; x <= part.right; ++x) compositor.end_layer(pixel_at(x, y));
    }
  };

  if (!limits.empty()) {
    for (std::int64_t y = box.top; y <= box.bottom; ++y) {
      for (std::int64_t x = box.left; x <= box.right; ++x) {
        if (double{limits[pixel_at(x, y)]} == -kNowhere) compositor.end(pixel_at(x, y));
      }
    }
  }
  std::uint64_t evaluations = 0;
  const std::span<const OrderedSplat> list = lists.list(tile);
  for (std::size_t e = 0; e < list.size(); ++e) {
    const PlacedSplat& placed = composition.splats[list[e].splat];
    const Footprint& footprint = placed.footprint;
    const glm::dvec3 colour(composition.colours[placed.kernel]);
    const glm::dvec3 normal = composition.normals.empty()
                                  ? glm::dvec3(0.0)
                                  : glm::dvec3(composition.normals[placed.kernel]);
    const PixelBox part = pixels_of(footprint, composition.tiling, box);
    for (std::int64_t y = part.top; y <= part.bottom; ++y) {
      for (std::int64_t x = part.left; x <= part.right; ++x) {
        const std::size_t pixel = pixel_at(x, y);
        if (compositor.is_done(pixel)) continue;
        const glm::dvec2 from_centre(static_cast<double>(x) + 0.5 - footprint.centre.x,
                                     height - static_cast<double>(y) - 0.5 - footprint.centre.y);
        const double q = footprint.q(from_centre);
        if (!(q < footprint.cutoff)) continue;
        ++evaluations;
        double weight = footprint.peak * std::exp(-0.5 * q);
        if (rule.weight == KernelWeight::Peak) {
          weight = std::min(weight, rule.max_alpha);
          if (weight < rule.min_alpha) continue;
        }
        const double limit = limits.empty() ? kNowhere : double{limits[pixel]};
        if (composition.order.has_slabs) {
          weight *= share_in_slab(footprint, from_centre, list[e].group, composition.order, limit);
        } else if (limit < kNowhere) {
          weight =
              weight_before(weight, share_before(footprint, from_centre, limit), rule.weight);
        }
        Layer& layer = compositor.layer(pixel);
        layer.depth_sum += weight;
        layer.colour += weight * colour;
        layer.normal += weight * normal;
        layer.place += weight * (footprint.depth + glm::dot(footprint.slope, from_centre));
      }
    }
    const bool ends_group = e + 1 == list.size() || list[e + 1].group != list[e].group;
    if (!ends_group) continue;
    // A group of one splat has touched its own pixels only.
    const bool is_single = e == 0 || list[e - 1].group != list[e].group;
    end_layers(is_single ? part : box);
    if (compositor.is_all_done(in_tile)) break;
  }
  return evaluations;
}

}  // namespace relief::volume_reference
