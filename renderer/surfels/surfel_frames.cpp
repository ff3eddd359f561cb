#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "common/is_finite.h"
#include "common/neighbours/neighbours.h"
#include "renderer/surfels/surfels.h"

namespace relief {
namespace {

/// Neighbours farther than so many radii don't say how a surfel bends.
constexpr double kReach = 3.0;
/// Neighbours whose normals are farther than 60 degrees away are of another surface.
constexpr double kLeastCosine = 0.5;
/// Residuals of slopes above that, about 9 degrees, count little: of neighbours beyond a crease.
constexpr double kOutlyingSlope = 0.15;
constexpr int kReweightings = 4;
/// The part of the neighbours' moments that is added to the fit's diagonal, so that neighbours on a
/// line don't make it bend across.
constexpr double kRidge = 1e-3;

/// A neighbour in the surfel's frame: where it is, in radii, and how its normal leans, as the slope
/// of a circle's height per arc: on a sphere it is exactly proportional to the offset.
struct Lean {
  glm::dvec2 offset{0.0};
  glm::dvec2 slope{0.0};
  double weight = 1.0;
};

using Leans = std::array<Lean, kSurfaceNeighbours>;

SurfelFrame frame_of(glm::dvec3 normal) {
  const glm::dvec3 size = glm::abs(normal);
  const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
  SurfelFrame frame;
  frame.u = glm::normalize(glm::cross(least, normal));
  frame.v = glm::cross(normal, frame.u);
  return frame;
}

glm::dvec2 slope_at(glm::dvec3 bend, glm::dvec2 offset) {
  return {bend.x * offset.x + bend.y * offset.y, bend.y * offset.x + bend.z * offset.y};
}

/// The bend whose slopes are nearest to the neighbours', by least squares.
glm::dvec3 fit(std::span<const Lean> leans) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  glm::dvec3 right(0.0);
  for (const Lean& lean : leans) {
    const glm::dvec2 o = lean.offset;
    xx += lean.weight * o.x * o.x;
    xy += lean.weight * o.x * o.y;
    yy += lean.weight * o.y * o.y;
    right += lean.weight * glm::dvec3(o.x * lean.slope.x, o.y * lean.slope.x + o.x * lean.slope.y,
                                      o.y * lean.slope.y);
  }
  const double ridge = kRidge * (xx + yy);
  if (!(ridge > 0.0)) return glm::dvec3(0.0);
  const glm::dmat3 left(xx + ridge, xy, 0.0, xy, xx + yy + 2.0 * ridge, xy, 0.0, xy, yy + ridge);
  return glm::inverse(left) * right;
}

/// What part of the neighbours' leaning is their bend: the rest is noise. 1 where the bend explains
/// all; 0 where it explains no more than three numbers fitted to noise do.
double explained_share(std::span<const Lean> leans, glm::dvec3 bend) {
  double weights = 0.0;
  double all = 0.0;
  double rest = 0.0;
  for (const Lean& lean : leans) {
    const glm::dvec2 error = lean.slope - slope_at(bend, lean.offset);
    weights += lean.weight;
    all += lean.weight * glm::dot(lean.slope, lean.slope);
    rest += lean.weight * glm::dot(error, error);
  }
  const double freedom = 2.0 * weights - 3.0;
  if (!(freedom > 0.0) || !(all > 0.0)) return 0.0;
  return std::clamp(1.0 - (rest / freedom) / (all / (2.0 * weights)), 0.0, 1.0);
}

/// Limits both principal curvatures to 1 per radius: the rim is then at most half a radius off the
/// plane, and leans by at most 45 degrees.
glm::dvec3 limit(glm::dvec3 bend) {
  const double mean = 0.5 * (bend.x + bend.z);
  const double half = 0.5 * (bend.x - bend.z);
  const double apart = std::hypot(half, bend.y);
  const double larger = std::clamp(mean + apart, -1.0, 1.0);
  const double smaller = std::clamp(mean - apart, -1.0, 1.0);
  const double shrink = apart > 0.0 ? 0.5 * (larger - smaller) / apart : 0.0;
  const double middle = 0.5 * (larger + smaller);
  return {middle + shrink * half, shrink * bend.y, middle - shrink * half};
}

/// The bend in radii, from neighbours that may lie beyond a crease: those that agree least with the
/// others come to count little.
glm::dvec3 robust_bend(std::span<Lean> leans) {
  for (Lean& lean : leans) {
    const double flatness = 1.0 - glm::dot(lean.slope, lean.slope);  // the normals' squared cosine
    lean.weight = flatness * flatness;
  }
  glm::dvec3 bend = fit(leans);
  for (int round = 0; round < kReweightings; ++round) {
    for (Lean& lean : leans) {
      const glm::dvec2 error = (lean.slope - slope_at(bend, lean.offset)) / kOutlyingSlope;
      const double divisor = 1.0 + glm::dot(error, error);
      lean.weight = 1.0 / (divisor * divisor);
    }
    bend = fit(leans);
  }
  return limit(bend * explained_share(leans, bend));
}

/// Turns the axes into the directions in which the surfel bends most and least. Nothing but the
/// surface then says how its curved shape is divided into triangles.
void turn_to_principal_directions(SurfelFrame& frame) {
  const glm::dvec3 bend = frame.bend;
  const double half = 0.5 * (bend.x - bend.z);
  const double apart = std::hypot(half, bend.y);
  if (!(apart > 0.0)) return;
  const double mean = 0.5 * (bend.x + bend.z);
  // The larger of the two by magnitude.
  const double sign = mean < 0.0 ? -1.0 : 1.0;
  const double angle = 0.5 * std::atan2(sign * bend.y, sign * half);
  const glm::dvec3 u = frame.u;
  frame.u = std::cos(angle) * u + std::sin(angle) * frame.v;
  frame.v = std::cos(angle) * frame.v - std::sin(angle) * u;
  frame.bend = {mean + sign * apart, 0.0, mean - sign * apart};
}

}  // namespace

// A normal that is not a unit vector makes a flat surfel that faces along z.
Result<std::vector<SurfelFrame>> find_surfel_frames(std::span<const glm::dvec3> positions,
                                                    std::span<const glm::vec3> normals,
                                                    std::span<const double> radii,
                                                    Progress& progress) {
  progress.begin_stage("surfel frames", positions.size());
  const NeighbourGraph graph =
      find_neighbours({positions.begin(), positions.end()}, kSurfaceNeighbours);
  if (progress.cancelled()) return interrupted_error();
  std::vector<SurfelFrame> frames(positions.size());
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, positions.size(), 1024), [&](const Range& range) {
    if (progress.cancelled()) return;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const double length = glm::length(glm::dvec3(normals[k]));
      const bool has_normal = length > 0.5 && length < 2.0;
      const glm::dvec3 normal = has_normal ? glm::dvec3(normals[k]) / length : glm::dvec3(0, 0, 1);
      SurfelFrame& frame = frames[k];
      frame = frame_of(normal);
      const double radius = radii[k];
      if (!has_normal || !std::isfinite(radius) || !(radius > 0.0)) continue;
      Leans leans;
      std::size_t count = 0;
      for (const std::uint32_t j : graph.of(k)) {
        const glm::dvec3 offset = (positions[j] - positions[k]) / radius;
        const glm::dvec3 leaning(normals[j]);
        if (!(glm::dot(offset, offset) < kReach * kReach)) break;  // nor are those farther away
        if (!is_finite(leaning) || !(glm::dot(leaning, normal) > kLeastCosine)) continue;
        leans[count++] = {{glm::dot(offset, frame.u), glm::dot(offset, frame.v)},
                          {-glm::dot(leaning, frame.u), -glm::dot(leaning, frame.v)}};
      }
      frame.bend = robust_bend(std::span(leans).first(count)) / radius;
      if (!is_finite(frame.bend)) frame.bend = glm::dvec3(0.0);  // of radii that are all but 0
      turn_to_principal_directions(frame);
    }
    progress.advance(range.size());
  });
  if (progress.cancelled()) return interrupted_error();
  return frames;
}

}  // namespace relief
