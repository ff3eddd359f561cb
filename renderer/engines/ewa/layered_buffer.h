// The layered frame buffer of [Zwicker 2001], section 6: a few fragments per pixel, each the
// contributions of one surface. With one layer, the frame buffer of section 4.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "renderer/engines/ewa/fragment.h"

namespace relief::ewa {

/// The filtered attributes of a fragment, as shading takes them.
struct Surface {
  std::size_t pixel = 0;
  glm::dvec3 albedo{0.0};  ///< linear
  glm::dvec3 normal{0.0};  ///< world, unit; 0 where normals cancel out
  double depth = 0.0;      ///< along the view axis
  /// What the normal changes by to the next pixel left, right, up and down; 0 where that shows
  /// another surface.
  std::array<glm::dvec3, 4> changes{};
  std::uint8_t material = 0;
  bool from_behind = false;  ///< seen from there
};

/// Gives the colour, linear, that a surface shows.
using ShadeSurface = std::function<glm::dvec3(const Surface&)>;

/// A pixel when all points have been splatted.
struct ResolvedPixel {
  glm::dvec4 colour{0.0};  ///< linear, premultiplied; alpha: coverage times opacity
  /// Of the fragment that is seen: the first from the front with which at least half of what the
  /// pixel's fragments cover is reached, so that a stray contribution before a surface is not it.
  double depth = 0.0;
  glm::dvec3 normal{0.0};
  glm::dvec2 uv{0.0};
  std::uint32_t patch = 0;
  std::uint8_t clip = 0;
};

/// Eq. (12): the front fragment over the back one. Colours premultiplied.
[[nodiscard]] glm::dvec4 blend_over(glm::dvec4 front, glm::dvec4 back);
/// Two fragments that cover parts of the pixel beside each other, as faces that meet in an edge.
[[nodiscard]] glm::dvec4 blend_beside(glm::dvec4 one, glm::dvec4 other);
/// A fragment behind one that ends with it, as faces that meet in a contour.
[[nodiscard]] glm::dvec4 blend_behind(glm::dvec4 front, glm::dvec4 back);

class LayeredBuffer {
 public:
  /// For `rows` of `width` pixels. `layers` >= 1, `coverage_threshold` (tau) > 0. `shade` is called
  /// once per fragment.
  LayeredBuffer(std::size_t width, std::size_t rows, int layers, double coverage_threshold,
                ShadeSurface shade);

  /// Adds a contribution to a pixel. One layer: to the fragment if it is the same surface,
  /// otherwise the nearer of both stays (section 4). More: to the fragment nearest in depth that is
  /// not yet shaded, if it is the same surface; otherwise it starts a fragment. If there are then
  /// more than `layers`, those behind an opaque one that covers the pixel go; if there are none,
  /// the two closest in depth are shaded and merged by Eq. (12).
  void add(std::size_t pixel, const Contribution& contribution, const SplatAttributes& attributes);

  /// Shades what is not yet shaded and blends back to front. Alpha 0 if there is nothing. Once per
  /// pixel.
  [[nodiscard]] ResolvedPixel resolve(std::size_t pixel);

 private:
  [[nodiscard]] bool single() const { return slots_ == 2; }
  void start_fragment(std::size_t pixel, const Fragment& fragment);
  void make_room(std::size_t pixel);
  void merge_closest(std::size_t pixel);
  void shade_once(std::size_t pixel, Fragment& fragment) const;
  [[nodiscard]] glm::dvec3 normal_change(const Fragment& fragment, std::size_t neighbour) const;

  std::size_t width_;
  std::size_t slots_;  ///< per pixel: layers, and one for the temporary fragment
  double coverage_threshold_;
  ShadeSurface shade_;
  std::vector<Fragment> fragments_;
  std::vector<std::size_t> counts_;  ///< fragments of each pixel
};

}  // namespace relief::ewa
