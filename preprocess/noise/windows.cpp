#include "preprocess/noise/windows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
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

/// Neighbouring slots are near each other: so many of them share a window where windows have at
/// least so many points.
struct Sharing {
  std::uint32_t slots;
  double fewest_points;
};
// Large groups first: the windows of smaller ones are found only where theirs are small. A point
// lies in eight windows or more. With windows of twice as many points (and as before, with groups
// of eight from 100 on) Igea with noise of one spacing takes 1.3 (2.4) times as long; what is left
// of noise on it, bun_zipper and fandisk differs by 1 %, six seeds each.
constexpr std::array<Sharing, 4> kSharings = {{{16, 128.0}, {8, 64.0}, {4, 32.0}, {2, 16.0}}};
constexpr std::uint32_t kGrain = 64;  // slots

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

/// What is known of the window of a slot: its own, or that of the first slot of its group.
enum class Slot : std::uint8_t { Open, Own, Shares };

static_assert((Rings::kCount - kFirstRings) % kMoreRings == 0);

}  // namespace

std::vector<NoiseWindow> find_windows(const PositionTree& tree,
                                      const std::vector<glm::dvec3>& centres,
                                      const std::vector<float>& spacing,
                                      const std::vector<float>& noise, Progress& progress) {
  const auto count = static_cast<std::uint32_t>(centres.size());
  std::vector<NoiseWindow> windows(count);
  std::vector<Slot> slots(count, Slot::Open);
  /// Finds the windows of every `step`th slot that is open.
  const auto find_each = [&](std::uint32_t step) {
    const tbb::blocked_range<std::uint32_t> all(0, (count + step - 1) / step,
                                                std::max(kGrain / step, 1U));
    tbb::parallel_for(all, [&](const auto& range) {
      if (progress.cancelled()) return;
      Rings rings(tree);
      QuadricFit fit;
      for (std::uint32_t slot = range.begin() * step; slot < range.end() * step && slot < count;
           slot += step) {
        if (slots[slot] != Slot::Open) continue;
        slots[slot] = Slot::Own;
        progress.advance(1);
        NoiseWindow& window = windows[slot];
        window.centre = centres[slot];
        if (!(noise[slot] > 0.0F) || !(spacing[slot] > 0.0F)) continue;
        window.unit = spacing[slot];
        grow_window(rings, fit, noise[slot] / spacing[slot], window);
      }
    });
  };
  /// Lets the slots of a group share its first one's window if that and its neighbours are large.
  const auto share = [&](const Sharing& sharing) {
    const auto is_large = [&](std::uint32_t first) {
      return first >= count || slots[first] == Slot::Shares ||
             windows[first].points >= sharing.fewest_points;
    };
    std::vector<std::uint32_t> shared;  // first slots
    for (std::uint32_t first = 0; first < count; first += sharing.slots) {
      if (slots[first] == Slot::Own && is_large(first) && is_large(first + sharing.slots) &&
          (first == 0 || is_large(first - sharing.slots)))
        shared.push_back(first);
    }
    for (const std::uint32_t first : shared) {
      const std::uint32_t end = std::min(first + sharing.slots, count);
      windows[first].stands_for = end - first;
      for (std::uint32_t slot = first; slot < end; ++slot) {
        slots[slot] = Slot::Shares;
        windows[slot].centre = centres[slot];
        windows[slot].unit = noise[slot] > 0.0F ? spacing[slot] : 0.0F;
      }
      progress.advance(end - first - 1);  // the first has been counted
    }
  };
  for (const Sharing& sharing : kSharings) {
    find_each(sharing.slots);
    share(sharing);
  }
  find_each(1);
  return windows;
}

}  // namespace relief
