#include "renderer/clip/lines/clip_splat.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "renderer/clip/lines/bounding_lines.h"
#include "renderer/clip/lines/clip_sides.h"
#include "renderer/clip/lines/partner_sets.h"
#include "renderer/clip/lines/plane_line.h"

namespace relief {
namespace {

/// Lines that differ by less than this share of the radius are one, and by what the noise of the
/// normals moves them.
constexpr double kFlat = 0.02;
constexpr double kMovedByNoise = 1.0;

std::vector<LineGroup> groups_of(ClipRule rule, PartnerSets& sets,
                                 std::span<const PlaneLine> lines) {
  if (rule == ClipRule::Partners) return std::move(sets.groups);
  return lines_alone(rule == ClipRule::Nearest ? lines.first(1) : lines);
}

}  // namespace

ClippedSplat clip_splat(const SplatDiscs& discs, const DiscTree& tree, const Disc& splat,
                        std::span<const Partner> partners, ClipRule rule, double noise) {
  ClippedSplat clipped;
  const SplatFrame frame = frame_of(discs, splat);
  const std::vector<std::uint8_t> concave = concave_edges(tree, partners);
  std::vector<PlaneLine> lines;
  for (std::uint32_t p = 0; p < partners.size(); ++p) {
    // Eq. (18) and (19) as printed clip the centre if the splat sees what does not see it.
    if (partners[p].above * partners[p].splat_above < 0.0) ++clipped.disagreements;
    const Disc& other = tree.discs()[partners[p].slot];
    if (const auto line = line_of(frame, other, partners[p], concave[p] != 0, p))
      lines.push_back(*line);
  }
  if (lines.empty()) return clipped;
  PartnerSets sets = group_lines(lines, (kFlat + kMovedByNoise * noise) * splat.radius);
  clipped.kind = sets.kind;
  std::vector<LineGroup> groups = groups_of(rule, sets, lines);
  // With Wicke's rule every line counts where its partner is one of the two nearest.
  if (rule != ClipRule::Wicke) keep_bounding_lines(groups, frame);
  for (const LineGroup& group : groups) {
    for (const PlaneLine& line : group) {
      const Partner& partner = partners[line.partner];
      const Disc& other = tree.discs()[partner.slot];
      clipped.lines.push_back({glm::vec3(line.direction.x * frame.x + line.direction.y * frame.y),
                               static_cast<float>(line.offset), other.splat,
                               &line == &group.back()});
      if (rule == ClipRule::Wicke)
        clipped.planes.push_back(
            {glm::vec3(partner.centre), glm::vec3(other.normal), concave[line.partner] != 0});
    }
  }
  return clipped;
}

}  // namespace relief
