// The lines that clip splats at sharp features, from the splats alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/settings.h"

namespace relief {

/// The discs that an engine draws, world frame. Vectors are as long as `centres`, or empty where
/// said.
struct SplatDiscs {
  std::vector<glm::dvec3> centres;
  std::vector<glm::dvec3> normals;  ///< unit, outward
  std::vector<double> radii;  ///< as drawn: where a splat ends; of ellipses the major semi-axis
  std::vector<glm::dvec3> major_axes;  ///< unit, in the disc's plane; empty: all are circles
  std::vector<double> minor_radii;     ///< minor semi-axes; empty with `major_axes`
};

/// How the partners of a splat lie (Figure 5); what the output `clip` shows.
enum class ClipKind : std::uint8_t { None, Flat, Union, Intersection, Mixed };

/// A half-plane's border in the plane of a splat: a point P of the plane is beyond it where
/// dot(P - centre, direction) > offset.
struct ClipLine {
  glm::vec3 direction{0.0F};  ///< world, unit, in the splat's plane
  float offset = 0.0F;        ///< world units; negative where the splat's centre is beyond
  std::uint32_t partner = 0;  ///< the splat whose plane this is
  bool ends_group = true;     ///< the next line is of another group
};

/// The plane of a line's partner, for the rule of Wicke.
struct PartnerPlane {
  glm::vec3 centre{0.0F};  ///< relative to the splat's centre, world
  glm::vec3 normal{0.0F};
  bool edge_is_concave = false;  ///< that between the splat and the partner
};

/// What the classification found.
struct ClipCounts {
  std::array<std::size_t, 5> kinds{};  ///< splats of each ClipKind
  std::uint64_t neighbours = 0;        ///< of all splats, Eq. (1): pairs, each counted twice
  std::uint64_t partners = 0;          ///< of all splats: pairs, each counted twice
  /// Of these, where the direction of Eq. (18) and (19) clips the splat's centre, which Figure 6
  /// keeps.
  std::uint64_t disagreements = 0;
  std::size_t cut = 0;     ///< splats with more neighbours or partners than are looked at
  double threshold = 1.0;  ///< w_s of Eq. (2); the median if splats have their own
};

/// The clip lines of all splats. A fragment of a splat is clipped where it is beyond all lines of
/// any one group: the union of lines is a group for each, their intersection one group for all.
/// With ClipRule::Wicke groups mean nothing: see wicke_clips().
struct ClipPartners {
  std::vector<std::uint32_t> first;  ///< of each splat, and the number of lines as the last
  std::vector<ClipLine> lines;
  std::vector<ClipKind> kinds;       ///< of each splat
  std::vector<PartnerPlane> planes;  ///< of each line; empty unless the rule is Wicke
  ClipCounts counts;

  [[nodiscard]] std::span<const ClipLine> of(std::size_t splat) const {
    return std::span(lines).subspan(first[splat], first[splat + 1] - first[splat]);
  }
  [[nodiscard]] std::span<const PartnerPlane> planes_of(std::size_t splat) const {
    return std::span(planes).subspan(first[splat], first[splat + 1] - first[splat]);
  }
};

/// Finds the lines that clip the discs. Fails only if it is interrupted.
///
/// Takes any input: discs without a place, a normal or an area have no partners. At most 4096
/// discs near a splat are looked at, and 2^27 partners are kept, at most 256 for each splat, the
/// nearest; `counts.cut` says for how many splats that was too few.
Result<ClipPartners> find_clip_partners(const SplatDiscs& discs, const ClipSettings& settings,
                                        Progress& progress);

/// Whether a point of the splat's plane, as its offset from the centre (world), is clipped.
[[nodiscard]] inline bool is_clipped(std::span<const ClipLine> lines, glm::vec3 offset) {
  bool beyond_all = true;
  for (const ClipLine& line : lines) {
    beyond_all = beyond_all && offset.x * line.direction.x + offset.y * line.direction.y +
                                       offset.z * line.direction.z >
                                   line.offset;
    if (!line.ends_group) continue;
    if (beyond_all) return true;
    beyond_all = true;
  }
  return false;
}

}  // namespace relief
