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
#include "renderer/clip/disc_overlap.h"
#include "renderer/clip/disc_tree.h"

namespace relief {

/// Which normals are of different surfaces.
struct SurfaceTest {
  /// w_s of Eq. (2): smaller dot products are of different surfaces.
  double threshold = 1.0;
  /// Planes whose normals' cross product is shorter are parallel: the two sides of a thin wall have
  /// opposite normals, but no edge.
  double min_sine = 0.0;

  [[nodiscard]] bool differ(const Disc& a, const Disc& b) const;
};

/// A clip partner, as its splat sees it.
struct Partner {
  std::uint32_t slot;  ///< in the tree
  double squared_distance;
  CrossingLine line;  ///< relative to the splat's centre
  Span span;          ///< of the line, in both discs
  bool is_seen;       ///< its centre is in front of the splat's plane
  bool sees;          ///< the splat's centre is in front of its plane
};

/// Returns another disc as the clip partner of a splat; none if they are of one surface or do not
/// cross. Symmetric to the last bit.
[[nodiscard]] std::optional<Partner> as_partner(const SplatDiscs& discs, const SurfaceTest& test,
                                                const Disc& splat, const Disc& other,
                                                std::uint32_t other_slot);

/// Limits that bound time and memory.
struct PartnerLimits {
  std::size_t tested;    ///< discs that are looked at for a splat
  std::size_t partners;  ///< of a splat
};

/// The partners of all discs of a tree, as slots: symmetric, those of a disc nearest first.
struct PartnerLists {
  std::vector<std::size_t> first;  ///< of each slot, and the number of partners as the last
  std::vector<std::uint32_t> slots;
  std::size_t cut = 0;  ///< discs that have more neighbours or partners than the limits

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
