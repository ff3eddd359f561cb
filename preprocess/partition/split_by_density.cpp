#include "preprocess/partition/split_by_density.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace relief {
namespace {

// Smaller pieces are noise of the spacing, and join what surrounds them.
constexpr std::size_t kFewestPiecePoints = 64;
constexpr std::uint32_t kNoBand = 0xFFFFFFFFU;

/// Bands of spacing, each at most kWidestDensityRatio wide.
struct Bands {
  double narrowest = 0.0;  ///< logarithm of the spacing that a tenth of the area falls below
  double width = 0.0;      ///< of a band, in the logarithm
  std::uint32_t count = 1;

  [[nodiscard]] std::uint32_t of(float spacing) const {
    const double at = (std::log(double{spacing}) - narrowest) / width;
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, count - 1.0));
  }
};

/// The spacing that this share of the area falls below. `spacings`: ascending.
double quantile_of_area(const std::vector<float>& spacings, double share) {
  double area = 0.0;
  for (const float s : spacings) area += double{s} * s;
  double below = 0.0;
  for (const float s : spacings) {
    below += double{s} * s;
    if (below >= share * area) return s;
  }
  return spacings.back();
}

Bands bands_of(const SurfaceSamples& samples, const Region& region) {
  std::vector<float> spacings;
  spacings.reserve(region.points.size());
  for (const std::uint32_t i : region.points) spacings.push_back(samples.spacing[i]);
  std::sort(spacings.begin(), spacings.end());
  const double dense = quantile_of_area(spacings, 0.1);
  const double sparse = quantile_of_area(spacings, 0.9);
  if (spacings.size() < 2 * kFewestPiecePoints || !(dense > 0.0) ||
      sparse <= kWidestDensityRatio * dense)
    return {};
  const double range = std::log(sparse / dense);
  const double count = std::ceil(range / std::log(kWidestDensityRatio));
  return {std::log(dense), range / count, static_cast<std::uint32_t>(count)};
}

/// The connected pieces of a region's bands, with the band of each.
std::vector<std::pair<Region, std::uint32_t>> pieces_of_bands(
    const SurfaceSamples& samples, const NeighbourGraph& graph, const Region& region,
    std::uint32_t bands, const std::vector<std::uint32_t>& band_of) {
  std::vector<Region> whole(bands);
  for (const std::uint32_t i : region.points) whole[band_of[i]].points.push_back(i);
  for (Region& band : whole) band.normal = region.normal;
  std::vector<std::pair<Region, std::uint32_t>> pieces;
  for (Region& piece : part_components(samples, graph, whole)) {
    const std::uint32_t band = band_of[piece.points.front()];
    pieces.emplace_back(std::move(piece), band);
  }
  return pieces;
}

/// The other band that most neighbours of a piece are in; its own if none has any.
std::uint32_t band_around(const NeighbourGraph& graph, const Region& piece, std::uint32_t own,
                          const std::vector<std::uint32_t>& band_of) {
  std::map<std::uint32_t, std::size_t> votes;
  for (const std::uint32_t i : piece.points) {
    for (const std::uint32_t j : graph.of(i)) {
      if (band_of[j] != kNoBand && band_of[j] != own) ++votes[band_of[j]];
    }
  }
  const auto most = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? own : most->first;
}

}  // namespace

std::vector<Region> split_by_density(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                     std::vector<Region> regions) {
  std::vector<Region> split;
  std::vector<std::uint32_t> band_of(samples.positions.size(), kNoBand);
  for (Region& region : regions) {
    const Bands bands = bands_of(samples, region);
    if (bands.count < 2) {
      split.push_back(std::move(region));
      continue;
    }
    for (const std::uint32_t i : region.points) band_of[i] = bands.of(samples.spacing[i]);
    const auto scattered = pieces_of_bands(samples, graph, region, bands.count, band_of);
    for (const auto& [piece, band] : scattered) {
      if (piece.points.size() >= kFewestPiecePoints) continue;
      const std::uint32_t around = band_around(graph, piece, band, band_of);
      for (const std::uint32_t i : piece.points) band_of[i] = around;
    }
    for (auto& [piece, band] : pieces_of_bands(samples, graph, region, bands.count, band_of))
      split.push_back(std::move(piece));
    for (const std::uint32_t i : region.points) band_of[i] = kNoBand;
  }
  return split;
}

}  // namespace relief
