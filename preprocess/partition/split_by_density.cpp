#include "preprocess/partition/split_by_density.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "preprocess/partition/spacing_range.h"

namespace relief {
namespace {

// Smaller pieces are noise of the spacing, and join what surrounds them.
constexpr std::size_t kFewestPiecePoints = 64;
constexpr std::uint32_t kNoBand = 0xFFFFFFFFU;

/// Bands of spacing, each at most kWidestDensityRatio wide.
struct Bands {
  double narrowest = 0.0;  ///< logarithm of the spacing of the dense part
  double width = 0.0;      ///< of a band, in the logarithm
  std::uint32_t count = 1;

  [[nodiscard]] std::uint32_t of(float spacing) const {
    const double at = (std::log(double{spacing}) - narrowest) / width;
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, count - 1.0));
  }
};

Bands bands_of(const SurfaceSamples& samples, const Region& region) {
  const SpacingRange range = spacing_range(values_of(samples.spacing, region));
  if (region.points.size() < 2 * kFewestPiecePoints || range.ratio() <= kWidestDensityRatio)
    return {};
  const double width = std::log(range.ratio());
  const double count = std::ceil(width / std::log(kWidestDensityRatio));
  return {std::log(double{range.dense}), width / count, static_cast<std::uint32_t>(count)};
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

/// The bands beside a piece; kNoBand if there is none.
struct BandsBeside {
  std::uint32_t sparser = kNoBand;  ///< the nearest one
  std::uint32_t denser = kNoBand;

  void note(std::uint32_t own, std::uint32_t other) {
    if (other > own) sparser = std::min(sparser, other);
    if (other < own) denser = denser == kNoBand ? other : std::max(denser, other);
  }
};

/// Lets pieces of few points join the sparser band beside them, or else the denser one: a coarse
/// grid draws dense points, but a fine grid would draw each sparse point as a dot. Nearest points
/// are looked for both ways, as those of a sparse point at a dense part are all dense.
void join_small_pieces(const NeighbourGraph& graph, const Region& region,
                       const std::vector<std::pair<Region, std::uint32_t>>& pieces,
                       std::vector<std::uint32_t>& piece_of, std::vector<std::uint32_t>& band_of) {
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    for (const std::uint32_t i : pieces[p].first.points) piece_of[i] = p;
  }
  std::vector<BandsBeside> beside(pieces.size());
  for (const std::uint32_t i : region.points) {
    for (const std::uint32_t j : graph.of(i)) {
      if (band_of[j] == kNoBand || piece_of[j] == piece_of[i]) continue;
      beside[piece_of[i]].note(band_of[i], band_of[j]);
      beside[piece_of[j]].note(band_of[j], band_of[i]);
    }
  }
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    const auto& [piece, own] = pieces[p];
    if (piece.points.size() >= kFewestPiecePoints) continue;
    const std::uint32_t joined =
        beside[p].sparser != kNoBand ? beside[p].sparser : beside[p].denser;
    for (const std::uint32_t i : piece.points) band_of[i] = joined == kNoBand ? own : joined;
  }
}

}  // namespace

std::vector<Region> split_by_density(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                     std::vector<Region> regions) {
  std::vector<Region> split;
  std::vector<std::uint32_t> band_of(samples.positions.size(), kNoBand);
  std::vector<std::uint32_t> piece_of(samples.positions.size(), 0);
  for (Region& region : regions) {
    const Bands bands = bands_of(samples, region);
    if (bands.count < 2) {
      split.push_back(std::move(region));
      continue;
    }
    for (const std::uint32_t i : region.points) band_of[i] = bands.of(samples.spacing[i]);
    const auto scattered = pieces_of_bands(samples, graph, region, bands.count, band_of);
    join_small_pieces(graph, region, scattered, piece_of, band_of);
    for (auto& [piece, band] : pieces_of_bands(samples, graph, region, bands.count, band_of))
      split.push_back(std::move(piece));
    for (const std::uint32_t i : region.points) band_of[i] = kNoBand;
  }
  return split;
}

}  // namespace relief
