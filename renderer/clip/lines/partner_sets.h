// Whether the areas that partners clip are united or intersected.
#pragma once

#include <span>
#include <vector>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/lines/plane_line.h"

namespace relief {

/// Lines in groups: the areas of a group are intersected, the groups united.
struct PartnerSets {
  std::vector<LineGroup> groups;
  ClipKind kind = ClipKind::None;
};

/// Groups the lines of a splat, nearest partner first, by Figure 5 of [Ivo 2011], pair by pair.
///
/// Figure 5 intersects the areas of two partners if the splat with them is convex and they are
/// concave, or the other way round: then each partner's edge lies in the area that the other one
/// clips, and would be lost if the areas were united. That is tested here: the mean of both depths
/// is above `tolerance`, world units. Among lines that such pairs link, each makes a group with
/// those that it is not united with: beside a peg's foot a wall may be intersected with one tangent
/// and united with another. Of more than 32 linked lines all are one group, which
/// bounds the time. The paper asks once for all partners and their middle, Eq. (15) and
/// (16), and has no answer for mixed sets (record 0127 compares).
///
/// Of lines that are one within the tolerance the nearest partner's stands for all: the union of
/// lines that differ by noise would clip too much.
///
/// No splat loses its centre: where all lines of a group have it beyond them, the farthest one is
/// moved to it.
///
/// The kind is Flat if no two lines are united or intersected, Mixed if there are pairs of both
/// sorts.
[[nodiscard]] PartnerSets group_lines(std::span<const PlaneLine> lines, double tolerance);

/// The rival: every line for itself.
[[nodiscard]] std::vector<LineGroup> lines_alone(std::span<const PlaneLine> lines);

}  // namespace relief
