#include "renderer/clip/pairs/partners.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/clip/pairs/slot_pieces.h"

namespace relief {
namespace {

/// A centre nearer to a plane than a share of the mean radius may be on either side of it: the
/// surface bends by about three times the noise within a disc, and normals are estimates. On flat
/// faces nearly none are (record 0127).
constexpr double kNearPlane = 0.002;
constexpr double kNearOfNoise = 3.0;
constexpr double kMostNearPlane = 0.05;

/// Whether two discs disagree about the edge between them: it is convex for one, concave for the
/// other, and neither by a narrow margin. `noise` is that of the normals.
bool contradict(double above, double splat_above, double mean_radius, double noise) {
  const double near = std::min(kNearPlane + kNearOfNoise * noise, kMostNearPlane) * mean_radius;
  return above * splat_above < 0.0 && std::min(std::abs(above), std::abs(splat_above)) > near;
}

/// What a thread needs anew for each disc.
struct Found {
  std::vector<std::uint32_t> neighbours;
  std::vector<std::pair<double, std::uint32_t>> partners;  // squared distance, slot
};

/// Finds the partners of a disc, nearest first; at equal distances by number. Returns whether the
/// limits left out none.
bool find_of(const SplatDiscs& discs, const DiscTree& tree, const SurfaceTest& test,
             const PartnerLimits& limits, std::size_t slot, Found& found) {
  found.neighbours.clear();
  found.partners.clear();
  const bool saw_all = tree.neighbours(slot, limits.tested, found.neighbours);
  for (const std::uint32_t other : found.neighbours)
    if (const auto partner = as_partner(discs, tree, test, slot, other))
      found.partners.emplace_back(glm::dot(partner->centre, partner->centre), other);
  std::sort(found.partners.begin(), found.partners.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first
                              : tree.discs()[a.second].splat < tree.discs()[b.second].splat;
  });
  if (found.partners.size() <= limits.partners) return saw_all;
  found.partners.resize(limits.partners);
  return false;
}

/// Drops partners that do not have the disc as theirs: only discs at a limit have such.
void make_symmetric(PartnerLists& lists, const std::vector<std::uint8_t>& is_cut) {
  std::vector<std::uint32_t> sorted = lists.slots;
  std::vector<std::uint8_t> stays(sorted.size(), 1);
  const std::size_t count = lists.first.size() - 1;
  const auto begin_of = [&](std::size_t slot) {
    return sorted.begin() + static_cast<std::ptrdiff_t>(lists.first[slot]);
  };
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    if (is_cut[slot] != 0) std::sort(begin_of(slot), begin_of(slot + 1));
  });
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    for (std::size_t k = lists.first[slot]; k < lists.first[slot + 1]; ++k) {
      const std::uint32_t other = lists.slots[k];
      if (is_cut[other] != 0)
        stays[k] = std::binary_search(begin_of(other), begin_of(other + 1), slot) ? 1 : 0;
    }
  });
  std::size_t kept = 0;
  for (std::size_t slot = 0, k = 0; slot < count; ++slot) {
    const std::size_t end = lists.first[slot + 1];
    for (; k < end; ++k)
      if (stays[k] != 0) lists.slots[kept++] = lists.slots[k];
    lists.first[slot + 1] = kept;
  }
  lists.slots.resize(kept);
}

}  // namespace

std::optional<Partner> as_partner(const SplatDiscs& discs, const DiscTree& tree,
                                  const SurfaceTest& test, std::size_t slot, std::uint32_t other) {
  if (!test.differ(tree, slot, other)) return std::nullopt;
  const Disc& splat = tree.discs()[slot];
  const Disc& partner = tree.discs()[other];
  const glm::dvec3 between = partner.centre - splat.centre;
  const double above = glm::dot(between, splat.normal);
  const double splat_above = -glm::dot(between, partner.normal);
  const double mean_radius = 0.5 * (splat.radius + partner.radius);
  const double noise = std::max(test.noise(slot), test.noise(other));
  if (contradict(above, splat_above, mean_radius, noise)) return std::nullopt;
  // Both splats of a pair compute the same numbers, so that rounding makes no one-sided partner.
  const bool is_first = splat.splat < partner.splat;
  CrossingLine line = is_first ? crossing_line(splat, partner) : crossing_line(partner, splat);
  const auto span = is_first ? common_span(discs, line, splat, partner)
                             : common_span(discs, line, partner, splat);
  if (!span) return std::nullopt;
  if (!is_first) line.origin += between;
  return Partner{other, between, line, *span, above, splat_above};
}

Result<PartnerLists> find_partners(const SplatDiscs& discs, const DiscTree& tree,
                                   const SurfaceTest& test, const PartnerLimits& limits,
                                   Progress& progress) {
  const std::size_t count = tree.discs().size();
  std::vector<std::vector<std::uint32_t>> pieces(count_pieces(count));
  std::vector<std::uint64_t> neighbours(pieces.size(), 0);
  PartnerLists lists;
  lists.first.assign(count + 1, 0);
  std::vector<std::uint8_t> is_cut(count, 0);
  for_pieces(count, [&](std::size_t p, std::size_t begin, std::size_t end) {
    Found found;
    for (std::size_t slot = begin; slot < end && !progress.cancelled(); ++slot) {
      is_cut[slot] = find_of(discs, tree, test, limits, slot, found) ? 0 : 1;
      neighbours[p] += found.neighbours.size();
      lists.first[slot + 1] = found.partners.size();
      for (const auto& [squared, other] : found.partners) pieces[p].push_back(other);
    }
    progress.advance(end - begin);
  });
  if (progress.cancelled()) return interrupted_error();
  for (std::size_t slot = 0; slot < count; ++slot) lists.first[slot + 1] += lists.first[slot];
  lists.slots.reserve(lists.first.back());
  for (const auto& piece : pieces)
    lists.slots.insert(lists.slots.end(), piece.begin(), piece.end());
  for (const std::uint64_t some : neighbours) lists.neighbours += some;
  lists.cut = static_cast<std::size_t>(std::count(is_cut.begin(), is_cut.end(), 1));
  if (lists.cut > 0) make_symmetric(lists, is_cut);
  return lists;
}

}  // namespace relief
