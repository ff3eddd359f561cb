#include "renderer/clip/bodies.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace relief {
namespace {

template <class T>
std::vector<T> part_of(const std::vector<T>& all, std::size_t begin, std::size_t end) {
  if (all.empty()) return {};
  return {all.begin() + static_cast<std::ptrdiff_t>(begin),
          all.begin() + static_cast<std::ptrdiff_t>(end)};
}

SplatDiscs part_of(const SplatDiscs& discs, std::size_t begin, std::size_t end) {
  return {part_of(discs.centres, begin, end), part_of(discs.normals, begin, end),
          part_of(discs.radii, begin, end), part_of(discs.major_axes, begin, end),
          part_of(discs.minor_radii, begin, end)};
}

/// The threshold is the largest, which finds most edges.
void add_counts(const ClipCounts& part, ClipCounts& all) {
  for (std::size_t k = 0; k < all.kinds.size(); ++k) all.kinds[k] += part.kinds[k];
  all.neighbours += part.neighbours;
  all.partners += part.partners;
  all.disagreements += part.disagreements;
  all.cut += part.cut;
  all.threshold = std::max(all.threshold, part.threshold);
}

/// Appends what was found of the discs from `begin` on.
void append_partners(ClipPartners part, std::size_t begin, ClipPartners& all) {
  const auto lines = static_cast<std::uint32_t>(all.lines.size());
  all.first.pop_back();
  for (const std::uint32_t first : part.first) all.first.push_back(lines + first);
  for (ClipLine& line : part.lines) line.partner += static_cast<std::uint32_t>(begin);
  all.lines.insert(all.lines.end(), part.lines.begin(), part.lines.end());
  all.kinds.insert(all.kinds.end(), part.kinds.begin(), part.kinds.end());
  all.planes.insert(all.planes.end(), part.planes.begin(), part.planes.end());
  add_counts(part.counts, all.counts);
}

}  // namespace

Result<ClipPartners> find_clip_partners_of_bodies(const SplatDiscs& discs,
                                                  std::span<const std::size_t> ends,
                                                  const ClipSettings& settings,
                                                  Progress& progress) {
  if (ends.size() < 2) return find_clip_partners(discs, settings, progress);
  ClipPartners all;
  all.first = {0};
  all.counts.threshold = -1.0;
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    RELIEF_TRY_ASSIGN(ClipPartners part,
                      find_clip_partners(part_of(discs, begin, end), settings, progress));
    append_partners(std::move(part), begin, all);
    begin = end;
  }
  return all;
}

}  // namespace relief
