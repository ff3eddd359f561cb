#include "preprocess/noise/noise_level.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/median.h"
#include "common/neighbours/nearest_search.h"
#include "preprocess/noise/quadric_fit.h"
#include "preprocess/noise/rings.h"

namespace relief {
namespace {

// One point in 8 is looked at, and of large scans some 6,000; as many together show the noise.
constexpr std::uint32_t kShortestStride = 8;
constexpr std::uint32_t kEnough = 6'000;
constexpr std::uint32_t kPooled = 64;
// Of those together, this share is taken for flat, because detail leaves more over; that many
// standard deviations below the mean of normal values.
constexpr double kFlatShare = 0.3;
constexpr double kFlatDeviations = -0.524;
// What a quadric leaves over (rms), over the radius of its disc: at most this much if the disc is
// flat, this much in a ball of scattered points.
constexpr double kFlat = 0.2;
constexpr double kBall = 0.37;
// Small discs up to this thick may be of a surface, up to this ring: larger discs of thin bodies
// hold both sides. They are if they are steady: the next but one shows no more than 1.5 times the
// square of their noise. In a ball it shows 2.25 times as much.
constexpr double kThick = 0.33;
constexpr std::size_t kLastSmallRing = 3;
constexpr double kSteady = 1.5;
// A disc cuts thick noise off where it ends. By ring, the last for all others, the exponents of
// what it leaves of the square: measured on planes with noise of up to four spacings.
constexpr std::array<double, 4> kCutOff = {0.36, 0.44, 0.5, 0.57};
// How much the squares of what detail leaves over grow from a disc to the next but one, 2.25 times
// as large; 2.4 to 5 on scans without noise. The smallest, so that no detail counts as noise.
constexpr double kDetailGrowth = 2.4;
// The usual noise is the lower bound that this share of the places are below, and no place has more
// than that of kMost. Where a scan bends sharply the lower bounds are low: with the median, fandisk
// with noise of one spacing kept 0.44 of it, with this 0.37. Two near sheets look like noise of
// half their distance: without a bound, bun_zipper with noise of one spacing keeps 0.38 of it, for
// 0.28, and 1.1 % of its samples face inward, for 0.2 %.
constexpr double kUsual = 0.6;
constexpr double kMost = 0.95;

/// What quadrics leave over in the discs about a point: variances, units squared; negative: none.
using Profile = std::array<float, Rings::kCount>;

/// The variance of which a sample variance is the value that kFlatShare of them are below ([Wilson
/// and Hilferty 1931]).
double for_flat(double variance, double freedom) {
  const double part = 2.0 / (9.0 * freedom);
  const double root = 1.0 - part + kFlatDeviations * std::sqrt(part);
  return variance / (root * root * root);
}

Profile profile_at(const Rings& rings, QuadricFit& fit) {
  Profile profile;
  profile.fill(-1.0F);
  fit.start();
  for (std::size_t ring = 0; ring < rings.count(); ++ring) {
    fit.add(rings.of(ring));
    const std::optional<Quadric> quadric = fit.fit(rings.up_to(ring));
    if (!quadric) continue;
    const double freedom = static_cast<double>(rings.up_to(ring).size()) - 6.0;
    profile[ring] = static_cast<float>(for_flat(quadric->rms * quadric->rms, freedom));
  }
  return profile;
}

/// Bounds of the noise, units.
struct NoiseRange {
  double low = 0.0;   ///< what detail does not explain
  double high = 0.0;  ///< all that is left over
  /// Of a flat disc. Small thick ones tell what is usual; at edges they show more than there is:
  /// taken at their word, these cost edges of a noisy fandisk 2 degrees.
  bool is_flat = false;
};

/// The variance of the noise that leaves over so much in a ring's disc, which cuts it off.
double uncut(double variance, std::size_t ring) {
  const double left = 1.0 - variance / (kBall * kBall * Rings::squared_radius(ring));
  if (left <= 0.0) return std::numeric_limits<double>::infinity();
  return variance * std::pow(left, -kCutOff[std::min(ring, kCutOff.size() - 1)]);
}

/// The disc that shows the noise of profiles, by its ring: the first flat one, or a smaller one if
/// only that is steady. Nothing if every disc is a ball.
std::optional<std::size_t> telling_ring(const Profile& flat) {
  std::optional<std::size_t> thick;
  for (std::size_t ring = 0; ring + 2 < flat.size(); ++ring) {
    if (flat[ring] < 0.0F || flat[ring + 2] < 0.0F) continue;
    const bool is_steady = uncut(flat[ring + 2], ring + 2) <= kSteady * uncut(flat[ring], ring);
    const double share = std::sqrt(flat[ring] / Rings::squared_radius(ring));
    if (share <= kFlat) return thick && !is_steady ? thick : ring;
    if (share <= kThick && is_steady && ring <= kLastSmallRing && !thick) thick = ring;
  }
  return thick;
}

/// What profiles show of the noise; nothing if every disc is a ball.
std::optional<NoiseRange> range_of(const Profile& flat) {
  const std::optional<std::size_t> ring = telling_ring(flat);
  if (!ring) return std::nullopt;
  const double noise = uncut(flat[*ring], *ring);
  const double further = uncut(flat[*ring + 2], *ring + 2);
  const double least = (kDetailGrowth * noise - further) / (kDetailGrowth - 1.0);
  // By chance larger discs may have less.
  const double low = std::sqrt(std::max(least, 0.0));
  const bool is_flat = flat[*ring] <= kFlat * kFlat * Rings::squared_radius(*ring);
  return NoiseRange{low, std::max(low, std::sqrt(noise)), is_flat};
}

/// The positions that are looked at, each for as many slots of the tree as the stride.
struct Places {
  std::uint32_t stride = 1;
  std::vector<glm::dvec3> positions;
  std::vector<Profile> profiles;
};

Places look_at_places(const PositionTree& tree, const std::vector<float>& spacing) {
  Places places;
  places.stride = std::max(tree.size() / kEnough, kShortestStride);
  const std::uint32_t count = (tree.size() + places.stride - 1) / places.stride;
  places.positions.resize(count);
  places.profiles.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 64), [&](const auto& range) {
    Rings rings(tree);
    QuadricFit fit;
    for (std::uint32_t p = range.begin(); p != range.end(); ++p) {
      const std::size_t slot = std::size_t{p} * places.stride;
      places.positions[p] = tree.at(slot);
      places.profiles[p].fill(-1.0F);
      if (!(spacing[slot] > 0.0F)) continue;
      rings.collect(places.positions[p], spacing[slot]);
      places.profiles[p] = profile_at(rings, fit);
    }
  });
  return places;
}

/// The value that kFlatShare of the values are below.
float flat_of(std::vector<float>& values) {
  const auto at = static_cast<double>(values.size()) * kFlatShare;
  const auto flat = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), flat, values.end());
  return *flat;
}

/// What the places about each one show together.
std::vector<std::optional<NoiseRange>> pool(const Places& places) {
  const auto count = static_cast<std::uint32_t>(places.positions.size());
  std::vector<std::optional<NoiseRange>> ranges(count);
  const std::uint32_t pooled = std::min(kPooled, count - 1);
  if (pooled == 0) return ranges;
  const PositionTree tree(places.positions);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 64), [&](const auto& range) {
    NearestSearch nearest(tree, pooled);
    std::vector<float> values;
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      nearest.find(slot);
      Profile flat;
      for (std::size_t ring = 0; ring < flat.size(); ++ring) {
        values.clear();
        for (std::uint32_t m = 0; m < pooled; ++m) {
          const float value = places.profiles[tree.index(nearest.slot(m))][ring];
          if (value >= 0.0F) values.push_back(value);
        }
        flat[ring] = 2 * values.size() > pooled ? flat_of(values) : -1.0F;
      }
      ranges[tree.index(slot)] = range_of(flat);
    }
  });
  return ranges;
}

/// The lower bound of noise that this share of the places are below, units.
double shown_by(const std::vector<std::optional<NoiseRange>>& ranges, double share) {
  std::vector<double> lows;
  for (const auto& range : ranges) {
    if (range) lows.push_back(range->low);
  }
  if (lows.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(lows.size()));
  std::nth_element(lows.begin(), lows.begin() + at, lows.end());
  return lows[at];
}

}  // namespace

std::vector<float> estimate_noise(const PositionTree& tree, const std::vector<float>& spacing) {
  std::vector<float> noise(tree.size());
  if (tree.size() == 0) return noise;
  const Places places = look_at_places(tree, spacing);
  const std::vector<std::optional<NoiseRange>> ranges = pool(places);
  const double usual = shown_by(ranges, kUsual);
  const double most = shown_by(ranges, kMost);
  const float usual_spacing = median_of(spacing);
  for (std::size_t slot = 0; slot < noise.size(); ++slot) {
    const std::optional<NoiseRange>& range = ranges[slot / places.stride];
    if (!range) {
      // Balls of sparse points are no surface, whose noise would grow with its spacing.
      noise[slot] = static_cast<float>(usual) * std::min(spacing[slot], usual_spacing);
      continue;
    }
    const double low = range->is_flat ? std::min(range->low, most) : 0.0;
    noise[slot] = static_cast<float>(std::clamp(usual, low, range->high)) * spacing[slot];
  }
  return noise;
}

}  // namespace relief
