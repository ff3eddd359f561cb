#include "preprocess/resample/heights/mls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "preprocess/normals/crease_sides.h"
#include "preprocess/resample/heights/fit_equations.h"

namespace relief {
namespace {

// The weight's scale in local scan spacings: small enough to keep the scan's detail, large enough
// for at least six points with weight. Dragon: docs/decisions/0036.
constexpr double kScaleInSpacings = 1.0;
// Minimum scale in grid spacings: a finer scan is averaged so that the grid does not alias.
constexpr double kScaleInGridSpacings = 0.5;
// Points beyond this many scales have weights below exp(-6.25) = 0.002 and are left out.
constexpr double kWeightCutoff = 2.5;
// Ridge on the second-order terms, relative to the sum of weights (coordinates scaled by s).
constexpr double kFitRidge = 2e-3;
// The fit may leave the points' own tangent planes by this many scales; further is an overshoot.
constexpr double kMaxOvershoot = 0.5;

// The nearest point is looked for within this many grid spacings.
constexpr double kNearestReach = 16.0;

// Points whose normals differ more from the nearest point's (60 degrees) lie beyond a crest: near
// on the base plane, but far on the surface.
constexpr float kMinLikeness = 0.5F;
// Tangent planes are blended within this many scales: twice that of the points that weigh most.
constexpr double kBlendReach = 2.0;

// Fitted normals may leave the mean normal by up to 37 degrees; further is an overshoot.
constexpr float kMinAgreement = 0.8F;

/// Two doubles in one SIMD register.
using Pair = double __attribute__((vector_size(16)));

/// The contribution of a point to a fit of `kValues` polynomials: its height and, where they are
/// asked for, the components of its normal.
template <std::size_t kValues>
struct Term {
  std::array<Pair, 3> basis;     // of the polynomial, there
  std::array<Pair, 3> weighted;  // that times the point's weight
  std::array<double, kValues> values;
};

/// The sums of a fit. Terms are added one by one, which defines the rounding, but sums stay in
/// registers: first half of the matrix, then the right side.
template <std::size_t kValues>
struct Sums {
  FitMatrix normal_matrix{};
  std::array<FitColumn, kValues> right_side{};
  double weight = 0.0;
  double tangent = 0.0;  // weighted heights of tangent planes: the cheap implicit surface
  glm::vec3 normal{0.0F};

  void add(std::span<const Term<kValues>> terms) {
    add_to_matrix(terms);
    add_to_right_side(terms);
  }

 private:
  void add_to_matrix(std::span<const Term<kValues>> terms) {
    std::array<std::array<Pair, 3>, 6> columns;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = c / 2; r < 3; ++r) columns[c][r] = pair_of(normal_matrix[c], r);
    }
    for (const Term<kValues>& term : terms) {
      for (std::size_t c = 0; c < 6; ++c) {
        for (std::size_t r = c / 2; r < 3; ++r)
          columns[c][r] += term.weighted[c / 2][c % 2] * term.basis[r];
      }
    }
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = c / 2; r < 3; ++r) set_pair(columns[c][r], r, normal_matrix[c]);
    }
  }

  void add_to_right_side(std::span<const Term<kValues>> terms) {
    std::array<std::array<Pair, 3>, kValues> columns;
    for (std::size_t c = 0; c < kValues; ++c) {
      for (std::size_t r = 0; r < 3; ++r) columns[c][r] = pair_of(right_side[c], r);
    }
    for (const Term<kValues>& term : terms) {
      for (std::size_t c = 0; c < kValues; ++c) {
        for (std::size_t r = 0; r < 3; ++r) columns[c][r] += term.values[c] * term.weighted[r];
      }
    }
    for (std::size_t c = 0; c < kValues; ++c) {
      for (std::size_t r = 0; r < 3; ++r) set_pair(columns[c][r], r, right_side[c]);
    }
  }

  static Pair pair_of(const FitColumn& column, std::size_t pair) {
    return Pair{column[2 * pair], column[2 * pair + 1]};
  }
  static void set_pair(Pair value, std::size_t pair, FitColumn& column) {
    column[2 * pair] = value[0];
    column[2 * pair + 1] = value[1];
  }
};

/// A weighted point of a fit.
struct Found {
  std::uint32_t point;
  double dz;       // above the spot
  double squared;  // distance, in scales
};

/// Number of points that are added at a time; most fits have 15 to 25.
constexpr std::size_t kBatch = 32;

/// Adds points.
template <std::size_t kValues>
void take_in(const PatchPoints& points, std::span<const Found> found, glm::dvec3 about,
             double scale, Sums<kValues>& sums) {
  std::array<Term<kValues>, kBatch> terms;
  for (std::size_t f = 0; f < found.size(); ++f) {
    const auto [p, dz, squared] = found[f];
    const double w = std::exp(-squared);
    const double dx = (points.positions[p].x - about.x) / scale;
    const double dy = (points.positions[p].y - about.y) / scale;
    const glm::vec3 n = points.normals[p];
    Term<kValues>& term = terms[f];
    term.basis = {Pair{1.0, dx}, Pair{dy, dx * dx}, Pair{dx * dy, dy * dy}};
    for (std::size_t r = 0; r < 3; ++r) term.weighted[r] = w * term.basis[r];
    if constexpr (kValues == 1)
      term.values = {dz / scale};
    else
      term.values = {dz / scale, n.x, n.y, n.z};
    sums.weight += w;
    sums.tangent += w * (tangent_height(points, p, about.x, about.y) - about.z);
    sums.normal += static_cast<float>(w) * n;
  }
  sums.add(std::span<const Term<kValues>>(terms).first(found.size()));
}

/// Sums up the points whose normals are `like` that one, a cosine.
template <std::size_t kValues>
Sums<kValues> accumulate(const PatchPoints& points, const PointGrid& lookup, glm::dvec3 about,
                         double scale, glm::vec3 normal, float like) {
  Sums<kValues> sums;
  std::array<Found, kBatch> found;
  std::size_t count = 0;
  lookup.for_each_within(about.x, about.y, kWeightCutoff * scale,
                         [&](std::uint32_t p, double plane_squared) {
                           const double dz = points.positions[p].z - about.z;
                           const double squared = (plane_squared + dz * dz) / (scale * scale);
                           if (squared > kWeightCutoff * kWeightCutoff) return;
                           if (glm::dot(normal, points.normals[p]) < like) return;
                           found[count++] = {p, dz, squared};
                           if (count < kBatch) return;
                           take_in(points, found, about, scale, sums);
                           count = 0;
                         });
  take_in(points, std::span(found).first(count), about, scale, sums);
  return sums;
}

glm::vec3 unit_or_up(glm::vec3 n) {
  const float length = glm::length(n);
  return length > 1e-6F ? n / length : glm::vec3(0.0F, 0.0F, 1.0F);
}

bool are_finite(const FitColumn& unknowns) {
  return std::ranges::all_of(unknowns, [](double x) { return std::isfinite(x); });
}

/// The surface above a position, on the tangent plane of the nearest point.
glm::dvec3 first_estimate(const PatchPoints& points, std::uint32_t nearest, glm::dvec2 at) {
  return {at, tangent_height(points, nearest, at.x, at.y)};
}

/// The scale of weights about a first estimate.
double scale_about(glm::dvec3 estimate, const PatchPoints& points, std::uint32_t nearest,
                   double spacing) {
  const double to_nearest = glm::distance(estimate, points.positions[nearest]);
  return std::max({kScaleInSpacings * points.spacing[nearest], kScaleInGridSpacings * spacing,
                   0.6 * to_nearest});
}

/// Fits the points about the tangent plane of the nearest, those with normals `like` that one.
template <std::size_t kValues>
MlsPoint fit(const PatchPoints& points, const PointGrid& lookup, std::uint32_t nearest,
             glm::dvec2 at, double spacing, glm::vec3 normal, float like) {
  const glm::dvec3 about = first_estimate(points, nearest, at);
  const double scale = scale_about(about, points, nearest, spacing);

  Sums<kValues> sums = accumulate<kValues>(points, lookup, about, scale, normal, like);
  if (!(sums.weight > 0.0)) return {about.z, normal, normal, true, 1.0, nearest};
  for (std::size_t d = 3; d < 6; ++d) sums.normal_matrix[d][d] += kFitRidge * sums.weight;
  for (std::size_t d = 1; d < 3; ++d) sums.normal_matrix[d][d] += 1e-6 * sums.weight;
  const FitEquations equations(sums.normal_matrix);
  std::array<FitColumn, kValues> fits;
  for (std::size_t c = 0; c < kValues; ++c) fits[c] = equations.solve(sums.right_side[c]);

  MlsPoint out;
  const FitColumn& height = fits[0];
  const double implicit = sums.tangent / sums.weight;
  const glm::vec3 mean = unit_or_up(sums.normal);
  const bool sound = std::ranges::all_of(fits, are_finite) &&
                     std::abs(height[0] * scale - implicit) <= kMaxOvershoot * scale;
  out.is_replaced = !sound;
  out.condition = equations.condition();
  out.height = about.z + (sound ? height[0] * scale : implicit);
  out.nearest = nearest;
  out.fitted_normal = sound ? unit_or_up(glm::vec3(-height[1], -height[2], 1.0)) : mean;
  if constexpr (kValues > 1) {
    // A mean is biased towards the denser side; the fitted value is not.
    const glm::vec3 fitted_mean = unit_or_up(glm::vec3(fits[1][0], fits[2][0], fits[3][0]));
    out.given_normal = sound && glm::dot(fitted_mean, mean) > kMinAgreement ? fitted_mean : mean;
  }
  return out;
}

}  // namespace

MlsPoint evaluate_mls(const PatchPoints& points, const PointGrid& supporting, const PointGrid& all,
                      double x, double y, double spacing, bool with_given_normal) {
  const std::uint32_t nearest = supporting.nearest(x, y, kNearestReach * spacing);
  if (nearest == PointGrid::kNone) return {0.0, {0, 0, 1}, {0, 0, 1}, true};
  const auto fit_to = with_given_normal ? fit<4> : fit<1>;
  return fit_to(points, all, nearest, {x, y}, spacing, points.normals[nearest], kMinLikeness);
}

MlsPoint blend_tangents(const PatchPoints& points, const PointGrid& supporting,
                        const PointGrid& all, double x, double y, double spacing) {
  const std::uint32_t nearest = supporting.nearest(x, y, kNearestReach * spacing);
  if (nearest == PointGrid::kNone) return {0.0, {0, 0, 1}, {0, 0, 1}, true};
  const glm::vec3 normal = points.normals[nearest];
  const glm::dvec3 about = first_estimate(points, nearest, {x, y});
  const double reach = kBlendReach * scale_about(about, points, nearest, spacing);
  double weights = 0.0;
  double height = 0.0;
  glm::vec3 mean(0.0F);
  all.for_each_within(x, y, reach, [&](std::uint32_t p, double plane_squared) {
    const double dz = points.positions[p].z - about.z;
    const double squared = (plane_squared + dz * dz) / (reach * reach);
    if (squared >= 1.0 || glm::dot(normal, points.normals[p]) < kMinLikeness) return;
    const double root = (1.0 - squared) * (1.0 - squared);
    const double weight = root * root;
    weights += weight;
    height += weight * (tangent_height(points, p, x, y) - about.z);
    mean += static_cast<float>(weight) * points.normals[p];
  });
  if (!(weights > 0.0)) return {about.z, normal, normal, true, 1.0, nearest};
  mean = unit_or_up(mean);
  return {about.z + height / weights, mean, mean, false, 1.0, nearest};
}

std::optional<MlsPoint> evaluate_mls_beside_crease(const PatchPoints& points, const PointGrid& own,
                                                   const PointGrid& all, glm::dvec2 at,
                                                   double reach, glm::vec3 normal, double spacing) {
  std::uint32_t nearest = PointGrid::kNone;
  double least = std::numeric_limits<double>::infinity();
  own.for_each_within(at.x, at.y, reach, [&](std::uint32_t p, double squared) {
    if (squared >= least || glm::dot(points.normals[p], normal) < kCreaseSideCosine) return;
    least = squared;
    nearest = p;
  });
  if (nearest == PointGrid::kNone) return {};
  return fit<1>(points, all, nearest, at, spacing, normal, kCreaseSideCosine);
}

}  // namespace relief
