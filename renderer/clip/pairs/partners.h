// The clip partners of splats: N_cp of [Ivo 2011].
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/pairs/different_surface.h"
#include "renderer/clip/pairs/disc_overlap.h"
#include "renderer/clip/pairs/disc_tree.h"

namespace relief {

/// A clip partner, as its splat sees it.
struct Partner {
  std::uint32_t slot;  ///< in the tree
  glm::dvec3 centre;   ///< relative to the splat's
  CrossingLine line;   ///< relative to the splat's centre
  Span span;           ///< of the line, in both discs
  double above;        ///< height of its centre above the splat's plane: is it seen, Eq. (16)
  double splat_above;  ///< height of the splat's centre above its plane: does it see, Eq. (14)
};

/// Returns another disc as the clip partner of a splat. None if they are of one surface, do not
/// cross, or contradict each other: one sees the other's centre, the other does not see its, and
/// neither is near the other's plane. Such planes cross where at least one of the surfaces is not.
/// Symmetric to the last bit.
[[nodiscard]] std::optional<Partner> as_partner(const SplatDiscs& discs, const DiscTree& tree,
                                                const SurfaceTest& test, std::size_t slot,
                                                std::uint32_t other);

/// Limits that bound time and memory.
struct PartnerLimits {
  std::size_t tested;    ///< discs that are looked at for a splat
  std::size_t partners;  ///< of a splat
};

/// The partners of all discs of a tree, as slots: symmetric, those of a disc nearest first.
struct PartnerLists {
  std::vector<std::size_t> first;  ///< of each slot, and the number of partners as the last
  std::vector<std::uint32_t> slots;
  std::uint64_t neighbours = 0;  ///< pairs that were tested, each from both sides
  std::size_t cut = 0;           ///< discs that have more neighbours or partners than the limits

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t slot) const {
    return std::span(slots).subspan(first[slot], first[slot + 1] - first[slot]);
  }
};

/// Finds the partners of all discs. Where a limit binds, a disc keeps the nearest ones that it
/// found, and a pair is dropped if one of both does not keep it. Advances by one unit for a disc.
/// Fails only if it is interrupted.
[[nodiscard]] Result<PartnerLists> find_partners(const SplatDiscs& discs, const DiscTree& tree,
                                                 const SurfaceTest& test,
                                                 const PartnerLimits& limits, Progress& progress);

}  // namespace relief
