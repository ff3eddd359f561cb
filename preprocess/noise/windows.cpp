#include "preprocess/noise/windows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "preprocess/noise/rings.h"

namespace relief {
namespace {

// Heights of two discs agree if they differ by less than this many of both standard deviations:
// with 2, 1, 0.85 and 0.7, Igea with noise of one spacing keeps 0.31, 0.28, 0.27 and 0.25 of it,
// bun_zipper 0.41, 0.39, 0.38 and 0.37, fandisk 0.36, 0.40, 0.41 and 0.42.
constexpr double kAgreeingDeviations = 0.85;
// A disc has no more noise than it should by this many: with 1 and 0 fandisk keeps 0.44 and 0.52.
constexpr double kDeviations = 2.0;
// A disc is at least twice as wide as its noise.
constexpr double kWidestInRadii = 0.5;
// What a quadric leaves over in a ball of scattered points is 0.4 of its radius (rms). There is no
// surface if that is also far more than the noise.
constexpr double kBallInRadii = 0.3;
constexpr double kFarMoreNoise = 1.5;
// A height this sure, in units, needs no larger disc: heights are rounded to a twentieth, and
// several windows together are surer still.
constexpr double kSure = 0.05;
// Neighbouring slots are near each other. One window in eight is found first; the others only where
// one of those is small.
constexpr std::uint32_t kShared = 8;
constexpr double kManyPoints = 100.0;

// Rings are collected in steps, of 17, 57, 200 and 650 points: most windows end before the last,
// and those of little noise with the first.
constexpr std::size_t kFirstRings = 2;
constexpr std::size_t kMoreRings = 3;

/// `noise`: in the window's units.
void grow_window(Rings& rings, QuadricFit& fit, double noise, NoiseWindow& window) {
  fit.start();
  std::size_t collected = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  for (std::size_t ring = 0; ring < Rings::kCount; ++ring) {
    if (ring == collected) {
      collected += ring == 0 ? kFirstRings : kMoreRings;
      rings.collect(window.centre, window.unit, collected);
    }
    if (ring >= rings.count()) return;
    fit.add(rings.of(ring));
    const double radius = Rings::radius(ring);
    if (noise > kWidestInRadii * radius) continue;
    const std::optional<Quadric> quadric = fit.fit(rings.up_to(ring));
    if (!quadric) continue;
    if (quadric->rms > std::max(kBallInRadii * radius, kFarMoreNoise * noise)) return;
    const auto count = static_cast<double>(rings.up_to(ring).size());
    const double most = noise * (1.0 + kDeviations / std::sqrt(2.0 * (count - 6.0)));
    const double deviation = noise * std::sqrt(quadric->leverage);
    const double height = -distance_to(*quadric, glm::dvec3(0.0)).distance;
    low = std::max(low, height - kAgreeingDeviations * deviation);
    high = std::min(high, height + kAgreeingDeviations * deviation);
    if (window.exists() && (quadric->rms > most || low > high)) return;
    window.quadric = *quadric;
    window.squared_radius = radius * radius;
    window.points = count;
    if (deviation < kSure) return;
  }
}

static_assert((Rings::kCount - kFirstRings) % kMoreRings == 0);

}  // namespace

std::vector<NoiseWindow> find_windows(const PositionTree& tree,
                                      const std::vector<glm::dvec3>& centres,
                                      const std::vector<float>& spacing,
                                      const std::vector<float>& noise, Progress& progress) {
  const auto count = static_cast<std::uint32_t>(centres.size());
  std::vector<NoiseWindow> windows(count);
  const auto find_at = [&](std::uint32_t slot, Rings& rings, QuadricFit& fit) {
    windows[slot].centre = centres[slot];
    if (!(noise[slot] > 0.0F) || !(spacing[slot] > 0.0F)) return;
    windows[slot].unit = spacing[slot];
    grow_window(rings, fit, noise[slot] / spacing[slot], windows[slot]);
  };
  const std::uint32_t groups = (count + kShared - 1) / kShared;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, groups, 8), [&](const auto& range) {
    if (progress.cancelled()) return;
    Rings rings(tree);
    QuadricFit fit;
    for (std::uint32_t group = range.begin(); group != range.end(); ++group)
      find_at(group * kShared, rings, fit);
  });
  const auto is_large = [&](std::uint32_t group) {
    return group >= groups || windows[std::size_t{group} * kShared].points >= kManyPoints;
  };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, groups, 8), [&](const auto& range) {
    if (progress.cancelled()) return;
    Rings rings(tree);
    QuadricFit fit;
    for (std::uint32_t group = range.begin(); group != range.end(); ++group) {
      const std::uint32_t first = group * kShared;
      const std::uint32_t end = std::min(first + kShared, count);
      const bool is_shared =
          is_large(group) && is_large(group + 1) && (group == 0 || is_large(group - 1));
      if (is_shared) windows[first].stands_for = end - first;
      for (std::uint32_t slot = first + 1; slot < end; ++slot) {
        if (!is_shared) {
          find_at(slot, rings, fit);
        } else {
          windows[slot].centre = centres[slot];
          windows[slot].unit = noise[slot] > 0.0F ? spacing[slot] : 0.0F;
        }
      }
    }
    progress.advance(kShared * range.size());
  });
  return windows;
}

}  // namespace relief
