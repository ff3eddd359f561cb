// What a pixel collects of one surface ([Zwicker 2001], table 1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace relief::ewa {

/// What a point brings to every pixel of its kernel.
struct SplatAttributes {
  glm::dvec4 colour{0.0};  ///< linear, not premultiplied; alpha: opacity
  glm::dvec3 normal{0.0};  ///< world, unit
  glm::dvec2 uv{0.0};
  std::uint32_t patch = 0;  ///< patch id + 1
  std::uint8_t material = 0;
  std::uint8_t clip = 0;    ///< ClipKind
  bool faces_away = false;  ///< from the eye
};

/// What a kernel contributes to a pixel. Depths along the view axis.
struct Contribution {
  double weight = 0.0;     ///< the kernel's value, or what clip lines keep of it; above 0
  double depth = 0.0;      ///< of the point's tangent plane at the pixel
  double threshold = 0.0;  ///< depths that differ by less are of one surface
  double lost = 0.0;       ///< what clip lines cut off
  glm::dvec2 beyond{0.0};  ///< across the line that does, away from what is kept; 0: none does
};

/// The contributions of one surface: sums of weight times attribute, divided by the weight when
/// they are looked at, Eq. (9).
struct Fragment {
  double weight = 0.0;  ///< sum of kernels: q of section 7
  double depth_sum = 0.0;
  /// Sums; once shaded the final colour: linear, premultiplied, alpha with the coverage in it.
  glm::dvec4 colour{0.0};
  glm::dvec3 normal_sum{0.0};
  glm::dvec2 uv_sum{0.0};  ///< of contributions of `patch` alone: grids of two patches don't mix
  double uv_weight = 0.0;  ///< their weight
  double away = 0.0;       ///< the weight of contributions that face away from the eye
  double largest = 0.0;    ///< the largest contribution's weight
  double threshold = 0.0;  ///< the largest of the contributions
  /// Contributions that lines cut: those that keep one side of an edge, and those of the other.
  struct Side {
    double kept = 0.0;
    double lost = 0.0;
  };
  std::array<Side, 2> sides{};
  glm::dvec2 edge{0.0};     ///< the first contribution's `beyond`
  std::uint32_t patch = 0;  ///< of the largest contribution; so are `material`, `clip`
  std::uint8_t material = 0;
  std::uint8_t clip = 0;
  bool faces_away = false;  ///< its first contribution
  bool is_clipped = false;  ///< some contribution
  bool shaded = false;      ///< once: the paper marks it by a negative weight

  [[nodiscard]] double depth() const { return depth_sum / weight; }
  /// The share of the pixel that it covers, once kernels sum up to the threshold: what lines keep
  /// of one face, and of the other one where two meet in an edge.
  [[nodiscard]] double coverage(double coverage_threshold) const {
    const double whole = weight + sides[0].lost + sides[1].lost;
    const double covered = std::min(whole / coverage_threshold, 1.0);
    if (!is_cut()) return covered;
    const double uncut = weight - sides[0].kept - sides[1].kept;
    double share = 0.0;
    for (const Side& side : sides)
      if (side.kept > 0.0) share += (side.kept + uncut) / (side.kept + side.lost + uncut);
    return covered * std::min(share, 1.0);
  }
  /// Whether nothing behind it can be seen. Equal sums of weight and weight * 1 are equal bits.
  [[nodiscard]] bool hides(double coverage_threshold) const {
    return shaded ? colour.a >= 1.0
                  : weight >= coverage_threshold && colour.a >= weight && !is_cut();
  }

  /// Whether its back is seen. At contours, kernels of both sides reach the same pixels; to reverse
  /// normals there puts dark specks on the rim: 1.3 dB of Lucy from a half on, 0.05 from this
  /// share.
  [[nodiscard]] bool is_from_behind() const { return away > 0.9 * weight; }

  /// Whether a contribution is of the other side of a sharp edge: within the threshold of depth the
  /// face that is seen and the one behind it that faces away lie beside each other.
  [[nodiscard]] bool is_beyond_edge(const SplatAttributes& a) const {
    return faces_away != a.faces_away && (is_clipped || a.clip != 0);
  }

  [[nodiscard]] bool is_cut() const { return sides[0].kept > 0.0; }

  /// Whether it and another one meet in a sharp edge: they cover parts of the pixel beside each
  /// other.
  [[nodiscard]] bool meets(const Fragment& other) const {
    return is_clipped && other.is_clipped &&
           std::abs(depth() - other.depth()) < std::max(threshold, other.threshold);
  }

  void add(const Contribution& c, const SplatAttributes& a) {
    if (weight == 0.0) faces_away = a.faces_away;
    is_clipped = is_clipped || a.clip != 0;
    weight += c.weight;
    if (a.faces_away) away += c.weight;
    if (c.beyond != glm::dvec2(0.0)) {
      if (!is_cut()) edge = c.beyond;
      Side& side = sides[glm::dot(edge, c.beyond) < 0.0 ? 1 : 0];
      side.kept += c.weight;
      side.lost += c.lost;
    }
    threshold = std::max(threshold, c.threshold);
    depth_sum += c.weight * c.depth;
    colour += c.weight * a.colour;
    normal_sum += c.weight * a.normal;
    if (c.weight > largest) {
      largest = c.weight;
      material = a.material;
      clip = a.clip;
      if (patch != a.patch) {
        patch = a.patch;
        uv_sum = glm::dvec2(0.0);
        uv_weight = 0.0;
      }
    }
    if (a.patch != patch) return;
    uv_sum += c.weight * a.uv;
    uv_weight += c.weight;
  }
};

}  // namespace relief::ewa
