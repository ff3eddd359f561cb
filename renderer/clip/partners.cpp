#include "renderer/clip/partners.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace relief {

bool SurfaceTest::differ(const Disc& a, const Disc& b) const {
  const double cosine = glm::dot(a.normal, b.normal);
  // The sine from the cross product: 1 - cosine^2 has no digits left where it matters.
  const glm::dvec3 cross = glm::cross(a.normal, b.normal);
  return cosine < threshold && glm::dot(cross, cross) > min_sine * min_sine;
}

std::optional<Partner> as_partner(const SplatDiscs& discs, const SurfaceTest& test,
                                  const Disc& splat, const Disc& other, std::uint32_t other_slot) {
  if (!test.differ(splat, other)) return std::nullopt;
  const glm::dvec3 between = other.centre - splat.centre;
  // Both splats of a pair compute the same numbers, so that rounding makes no one-sided partner.
  const bool is_first = splat.splat < other.splat;
  CrossingLine line = is_first ? crossing_line(splat, other) : crossing_line(other, splat);
  const auto span =
      is_first ? common_span(discs, line, splat, other) : common_span(discs, line, other, splat);
  if (!span) return std::nullopt;
  if (!is_first) line.origin += between;
  return Partner{other_slot,
                 glm::dot(between, between),
                 line,
                 *span,
                 glm::dot(between, splat.normal) > 0.0,
                 glm::dot(between, other.normal) < 0.0};
}

namespace {

/// Discs whose partners are found as one piece of work.
constexpr std::size_t kPiece = 512;

/// What a thread needs anew for each disc.
struct Found {
  std::vector<std::uint32_t> neighbours;
  std::vector<Partner> partners;
};

/// Finds the partners of a disc, nearest first; at equal distances by number. Returns whether a
/// limit left out none.
bool find_of(const SplatDiscs& discs, const DiscTree& tree, const SurfaceTest& test,
             const PartnerLimits& limits, std::size_t slot, Found& found) {
  found.neighbours.clear();
  found.partners.clear();
  const bool saw_all = tree.neighbours(slot, limits.tested, found.neighbours);
  const Disc& splat = tree.discs()[slot];
  for (const std::uint32_t other : found.neighbours)
    if (const auto partner = as_partner(discs, test, splat, tree.discs()[other], other))
      found.partners.push_back(*partner);
  std::sort(found.partners.begin(), found.partners.end(), [&](const Partner& a, const Partner& b) {
    return a.squared_distance != b.squared_distance
               ? a.squared_distance < b.squared_distance
               : tree.discs()[a.slot].splat < tree.discs()[b.slot].splat;
  });
  if (found.partners.size() <= limits.partners) return saw_all;
  found.partners.resize(limits.partners);
  return false;
}

/// Drops partners that do not have the disc as theirs: only discs at a limit have such.
void make_symmetric(PartnerLists& lists, const std::vector<std::uint8_t>& is_cut) {
  std::vector<std::size_t> first(lists.first.size(), 0);
  std::vector<std::uint32_t> kept;
  for (std::size_t slot = 0; slot + 1 < lists.first.size(); ++slot) {
    for (const std::uint32_t other : lists.of(slot)) {
      const auto others = lists.of(other);
      if (is_cut[other] != 0 && std::find(others.begin(), others.end(), slot) == others.end())
        continue;
      kept.push_back(other);
    }
    first[slot + 1] = kept.size();
  }
  lists.first = std::move(first);
  lists.slots = std::move(kept);
}

}  // namespace

Result<PartnerLists> find_partners(const SplatDiscs& discs, const DiscTree& tree,
                                   const SurfaceTest& test, const PartnerLimits& limits,
                                   Progress& progress) {
  const std::size_t count = tree.discs().size();
  std::vector<std::vector<std::uint32_t>> pieces((count + kPiece - 1) / kPiece);
  std::vector<std::uint32_t> sizes(count);
  std::vector<std::uint8_t> is_cut(count, 0);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    Found found;
    const std::size_t end = std::min((p + 1) * kPiece, count);
    for (std::size_t slot = p * kPiece; slot < end && !progress.cancelled(); ++slot) {
      is_cut[slot] = find_of(discs, tree, test, limits, slot, found) ? 0 : 1;
      sizes[slot] = static_cast<std::uint32_t>(found.partners.size());
      for (const Partner& partner : found.partners) pieces[p].push_back(partner.slot);
    }
    progress.advance(end - p * kPiece);
  });
  if (progress.cancelled()) return interrupted_error();
  PartnerLists lists;
  lists.first.assign(count + 1, 0);
  for (std::size_t slot = 0; slot < count; ++slot)
    lists.first[slot + 1] = lists.first[slot] + sizes[slot];
  lists.slots.reserve(lists.first.back());
  for (const auto& piece : pieces)
    lists.slots.insert(lists.slots.end(), piece.begin(), piece.end());
  lists.cut = static_cast<std::size_t>(std::count(is_cut.begin(), is_cut.end(), 1));
  if (lists.cut > 0) make_symmetric(lists, is_cut);
  return lists;
}

}  // namespace relief
