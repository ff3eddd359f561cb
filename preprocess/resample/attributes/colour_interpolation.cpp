#include "preprocess/resample/attributes/colour_interpolation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "common/image/srgb.h"

namespace relief {
namespace {

/// Number of points that a colour is interpolated from. A checker of 11 spacings, points at random:
/// 12 and 8 differ by 0.05 dB.
constexpr std::size_t kMaxPoints = 8;
/// Gradients are fitted with weights exp(-d^2 / s^2), and averaged with others, s in local scan
/// spacings; points farther than this many scales are ignored.
constexpr double kGradientScale = 1.5;
constexpr double kTensorScale = 1.2;
constexpr double kCutoff = 2.0;
/// Search radius for kriging, in spacings.
constexpr double kReach = 3.0;
/// Largest factor by which distances shrink along an edge and grow across it. Checker of 11
/// spacings, points on a loose grid: 1: 15.5 dB, 2: 16.8, 3: 17.3 with smoother gradients.
constexpr double kMaxSteering = 3.0;
/// Changes of colour per spacing below which there is no edge, and the ridge on gradients: noise of
/// 8-bit colours.
constexpr double kNoise = 0.02;
constexpr double kRidge = 1e-2;
/// Assumed distance of coinciding points, in spacings: they count as their mean.
constexpr double kNugget = 0.02;

using Weights = std::array<double, kMaxPoints>;
using Equations = Eigen::Matrix<double, kMaxPoints - 1, kMaxPoints - 1>;
using RightSide = Eigen::Matrix<double, kMaxPoints - 1, 1>;

/// Maps offsets on the base plane to offsets along a surface with this normal, up to a rotation.
glm::dmat2 along_surface(glm::vec3 normal) {
  const glm::dvec2 slope = slope_of(normal);
  const double squared = glm::dot(slope, slope);
  if (squared < 1e-12) return glm::dmat2(1.0);
  const double stretch = (std::sqrt(1.0 + squared) - 1.0) / squared;
  return glm::dmat2(1.0) + stretch * glm::outerProduct(slope, slope);
}

/// The points nearest to a position, nearest first.
class NearestPoints {
 public:
  struct Near {
    double squared = 0.0;  ///< distance, squared
    std::uint32_t point = 0;
  };

  void add(Near added) {
    if (count_ == kMaxPoints && !is_nearer(added, near_[kMaxPoints - 1])) return;
    if (count_ < kMaxPoints) ++count_;
    std::size_t at = count_ - 1;
    for (; at > 0 && is_nearer(added, near_[at - 1]); --at) near_[at] = near_[at - 1];
    near_[at] = added;
  }

  [[nodiscard]] std::size_t size() const { return count_; }
  const Near& operator[](std::size_t i) const { return near_[i]; }

 private:
  static bool is_nearer(const Near& a, const Near& b) {
    return a.squared != b.squared ? a.squared < b.squared : a.point < b.point;
  }

  std::array<Near, kMaxPoints> near_;
  std::size_t count_ = 0;
};

/// The weights of ordinary kriging whose variogram is the distance, of points at `offsets` from the
/// position, spacings: with distances d_ij between points and k_i to the position, sum_j d_ij w_j +
/// m = k_i for some m, and the weights sum to 1. The first point's weight is what the others leave,
/// which makes the equations positive definite.
Weights kriging_weights(std::span<const glm::dvec2> offsets) {
  const std::size_t others = offsets.size() - 1;
  // Points that are missing have weights of 0, so that the size is fixed.
  Equations equations = Equations::Identity();
  RightSide right = RightSide::Zero();
  std::array<double, kMaxPoints - 1> to_first{};
  for (std::size_t i = 0; i < others; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    to_first[i] = glm::distance(offsets[i + 1], offsets[0]);
    right[row] = to_first[i] + kNugget - glm::length(offsets[i + 1]) + glm::length(offsets[0]);
    for (std::size_t j = 0; j < i; ++j) {
      equations(row, static_cast<Eigen::Index>(j)) =
          to_first[i] + to_first[j] - glm::distance(offsets[i + 1], offsets[j + 1]) + kNugget;
    }
    equations(row, row) = 2.0 * (to_first[i] + kNugget);
  }
  const RightSide of_others = Eigen::LLT<Equations, Eigen::Lower>(equations).solve(right);
  Weights weights{1.0 - of_others.sum()};
  for (std::size_t i = 0; i < others; ++i) weights[i + 1] = of_others[static_cast<Eigen::Index>(i)];
  return weights;
}

std::vector<glm::vec3> linear_colours(const PatchPoints& points,
                                      const std::vector<glm::u8vec3>& colours) {
  std::vector<glm::vec3> linear;
  linear.reserve(points.size());
  for (const std::uint32_t id : points.ids) linear.push_back(linear_from_srgb8(colours[id]));
  return linear;
}

}  // namespace

ColourInterpolation::ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                                         const std::vector<glm::u8vec3>& colours)
    : ColourInterpolation(points, lookup, linear_colours(points, colours)) {}

ColourInterpolation::ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                                         std::vector<glm::vec3> values)
    : points_(points), lookup_(lookup), values_(std::move(values)) {
  tensors_.reserve(points.size());
  for (std::uint32_t p = 0; p < points.size(); ++p) tensors_.push_back(gradient_at(p));
}

ColourInterpolation::Tensor ColourInterpolation::gradient_at(std::uint32_t point) const {
  const glm::dvec3 middle = points_.positions[point];
  const double scale = kGradientScale * points_.spacing[point];
  // The normal equations of a linear function: 1, x, y in scales.
  glm::dmat3 sums(0.0);
  std::array<glm::dvec3, 3> right{};
  lookup_.for_each_within(middle.x, middle.y, kCutoff * scale, [&](std::uint32_t p, double square) {
    const double weight = std::exp(-square / (scale * scale));
    const glm::dvec3 basis(1.0, (points_.positions[p].x - middle.x) / scale,
                           (points_.positions[p].y - middle.y) / scale);
    sums += weight * glm::outerProduct(basis, basis);
    const glm::dvec3 value(values_[p] - values_[point]);
    for (glm::length_t k = 0; k < 3; ++k)
      right[static_cast<std::size_t>(k)] += weight * basis[k] * value;
  });
  sums[1][1] += kRidge;
  sums[2][2] += kRidge;
  const glm::dmat3 inverse = glm::inverse(sums);
  glm::dvec3 along_x(0.0);
  glm::dvec3 along_y(0.0);
  for (glm::length_t k = 0; k < 3; ++k) {
    along_x += inverse[k][1] * right[static_cast<std::size_t>(k)];
    along_y += inverse[k][2] * right[static_cast<std::size_t>(k)];
  }
  return Tensor(glm::dot(along_x, along_x), glm::dot(along_x, along_y),
                glm::dot(along_y, along_y)) /
         (scale * scale);
}

glm::dmat2 ColourInterpolation::metric_at(double x, double y, std::uint32_t nearest) const {
  const double spacing = points_.spacing[nearest];
  const double scale = kTensorScale * spacing;
  Tensor sum(0.0);
  double weights = 0.0;
  lookup_.for_each_within(x, y, kCutoff * scale, [&](std::uint32_t p, double square) {
    const double weight = std::exp(-square / (scale * scale));
    sum += weight * tensors_[p];
    weights += weight;
  });
  const glm::dmat2 surface = along_surface(points_.normals[nearest]) / spacing;
  if (weights <= 0.0) return surface;
  const glm::dmat2 gradients = glm::dmat2(sum.x, sum.y, sum.y, sum.z) / weights;
  const glm::dmat2 back = glm::inverse(surface);  // symmetric
  const glm::dmat2 tensor = back * gradients * back;
  const double mean = 0.5 * (tensor[0][0] + tensor[1][1]);
  const double half = 0.5 * (tensor[0][0] - tensor[1][1]);
  const double reach = std::hypot(half, tensor[0][1]);
  const double across = mean + reach + kNoise * kNoise;
  const double along = std::max(mean - reach, 0.0) + kNoise * kNoise;
  const double steering = std::min(kMaxSteering, std::sqrt(std::sqrt(across / along)));
  if (!(reach > 0.0)) return surface;
  // The square of the direction across the edge, by the half angle.
  const glm::dmat2 edge =
      glm::dmat2(0.5) + glm::dmat2(half, tensor[0][1], tensor[0][1], -half) * (0.5 / reach);
  const glm::dmat2 steered = glm::dmat2(1.0 / steering) + (steering - 1.0 / steering) * edge;
  return steered * surface;
}

glm::vec3 ColourInterpolation::at(double x, double y, std::uint32_t nearest) const {
  const glm::dmat2 metric = metric_at(x, y, nearest);
  const glm::dvec2 position(x, y);
  const double to_nearest = glm::length(glm::dvec2(points_.positions[nearest]) - position);
  const double reach = std::max(kReach * points_.spacing[nearest], 2.0 * to_nearest);
  const auto offset_of = [&](std::uint32_t p) {
    return metric * (glm::dvec2(points_.positions[p]) - position);
  };
  NearestPoints around;
  lookup_.for_each_within(x, y, reach, [&](std::uint32_t p, double /*square*/) {
    const glm::dvec2 offset = offset_of(p);
    around.add({glm::dot(offset, offset), p});
  });

  glm::vec3 low = values_[around[0].point];
  glm::vec3 high = low;
  for (std::size_t i = 1; i < around.size(); ++i) {
    low = glm::min(low, values_[around[i].point]);
    high = glm::max(high, values_[around[i].point]);
  }
  if (low == high) return low;

  std::array<glm::dvec2, kMaxPoints> offsets;
  for (std::size_t i = 0; i < around.size(); ++i) offsets[i] = offset_of(around[i].point);
  const Weights weights = kriging_weights(std::span(offsets).first(around.size()));
  glm::dvec3 colour(0.0);
  for (std::size_t i = 0; i < around.size(); ++i)
    colour += weights[i] * glm::dvec3(values_[around[i].point]);
  return glm::clamp(glm::vec3(colour), low, high);
}

}  // namespace relief
