// The pixels of a tile while splats are composited into them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/volume/splats/composite_rule.h"
#include "renderer/volume/splats/tile_lists.h"

namespace relief::volume_reference {

/// What a pixel shows.
struct VolumePixel {
  glm::dvec3 colour{0.0};  ///< times its opacity
  double transmittance = 1.0;
  glm::dvec3 normal{0.0};  ///< world, any length
  /// Along the view axis: where half of what is behind is covered; infinite if nothing is.
  double depth = std::numeric_limits<double>::infinity();
};

/// A layer in a pixel: sums over its splats.
struct Layer {
  double weight = 0.0;     ///< optical depth, or opacity
  glm::dvec3 colour{0.0};  ///< times that
  glm::dvec3 normal{0.0};  ///< likewise
  double place = 0.0;      ///< depth along the axis, times that
};

/// A tile's pixels, row by row from the top, kTile in a row.
class TilePixels {
 public:
  static constexpr std::size_t kCount = kTile * kTile;

  /// Of that box, which is the tile's part of the image. `limits` are the whole image's, as
  /// ImageRule's; its rows have `width` pixels.
  TilePixels(const PixelBox& box, std::span<const float> limits, std::int64_t width) : box_(box) {
    if (limits.empty()) return;
    limits_.resize(kCount, 0.0);
    for (std::int64_t y = box.top; y <= box.bottom; ++y) {
      for (std::int64_t x = box.left; x <= box.right; ++x) {
        const double limit = limits[static_cast<std::size_t>(y * width + x)];
        limits_[index(x, y)] = limit;
        if (limit == -std::numeric_limits<double>::infinity()) end(index(x, y));
      }
    }
  }

  [[nodiscard]] const PixelBox& box() const { return box_; }
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>((y - box_.top) * kTile + (x - box_.left));
  }
  [[nodiscard]] const VolumePixel& operator[](std::size_t pixel) const { return pixels_[pixel]; }
  /// The depth that ends what each pixel shows; empty: nothing does.
  [[nodiscard]] std::span<const double> limits() const { return limits_; }
  [[nodiscard]] bool is_all_done() const {
    return count_done_ ==
           static_cast<std::size_t>((box_.right - box_.left + 1) * (box_.bottom - box_.top + 1));
  }

  /// Puts a layer behind what a pixel shows [Zwicker 2002, Eq. (7) and (10)].
  void put_behind(std::size_t pixel, const Layer& layer, const CompositeRule& rule) {
    if (!(layer.weight > 0.0) || done_[pixel]) return;
    const double alpha = opacity_of(layer.weight, rule);
    VolumePixel& shown = pixels_[pixel];
    const double after = shown.transmittance * (1.0 - alpha);
    const bool ends = after < rule.min_transmittance;
    if (ends) {
      end(pixel);
      // As [Kerbl 2023] does: what would end a pixel is left out.
      if (rule.weight == KernelWeight::Peak) return;
    }
    const double share = shown.transmittance * alpha / layer.weight;
    shown.colour += share * layer.colour;
    shown.normal += share * layer.normal;
    if (shown.transmittance > 0.5 && after <= 0.5) shown.depth = layer.place / layer.weight;
    shown.transmittance = after;
  }

 private:
  void end(std::size_t pixel) {
    done_[pixel] = true;
    ++count_done_;
  }
  [[nodiscard]] static double opacity_of(double weight, const CompositeRule& rule) {
    const bool is_exponential =
        rule.weight == KernelWeight::Integral && rule.attenuation == Attenuation::Exponential;
    return std::min(is_exponential ? -std::expm1(-weight) : weight, rule.max_alpha);
  }

  PixelBox box_;
  std::array<VolumePixel, kCount> pixels_{};
  std::array<bool, kCount> done_{};
  std::vector<double> limits_;
  std::size_t count_done_ = 0;
};

}  // namespace relief::volume_reference
