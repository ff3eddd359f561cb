#include "renderer/clip/lines/partner_sets.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

namespace relief {
namespace {

/// How far a line's edge lies in the area that another line clips; negative outside it.
double edge_within(const PlaneLine& line, const PlaneLine& other) {
  return glm::dot(line.edge, other.direction) - other.offset;
}

enum class PairKind : std::uint8_t { Flat, Unite, Intersect };

PairKind kind_of(const PlaneLine& a, const PlaneLine& b, double tolerance) {
  const double within = 0.5 * (edge_within(a, b) + edge_within(b, a));
  if (within > tolerance) return PairKind::Intersect;
  return within < -tolerance ? PairKind::Unite : PairKind::Flat;
}

/// Whether two lines are one but for noise.
bool is_one(const PlaneLine& a, const PlaneLine& b, double tolerance) {
  constexpr double kAlike = 0.8;
  return glm::dot(a.direction, b.direction) > kAlike && kind_of(a, b, tolerance) == PairKind::Flat;
}

/// The lines that differ, each the nearest partner's of those that do not.
std::vector<PlaneLine> different_lines(std::span<const PlaneLine> lines, double tolerance) {
  std::vector<PlaneLine> different;
  for (const PlaneLine& line : lines)
    if (std::none_of(different.begin(), different.end(),
                     [&](const PlaneLine& other) { return is_one(line, other, tolerance); }))
      different.push_back(line);
  return different;
}

/// For each of some linked lines those that are not united with it, each set once. Of so many
/// lines that it would take long, all.
std::vector<LineGroup> groups_of_linked(std::span<const PlaneLine> lines, double tolerance) {
  constexpr std::size_t kMostTold = 32;
  if (lines.size() > kMostTold) return {LineGroup(lines.begin(), lines.end())};
  std::vector<LineGroup> groups;
  std::vector<std::uint32_t> known;  // sets of lines, a bit each
  for (const PlaneLine& line : lines) {
    LineGroup group;
    std::uint32_t members = 0;
    for (std::uint32_t k = 0; k < lines.size(); ++k) {
      if (kind_of(line, lines[k], tolerance) == PairKind::Unite) continue;
      group.push_back(lines[k]);
      members |= 1U << k;
    }
    if (std::ranges::find(known, members) != known.end()) continue;
    known.push_back(members);
    groups.push_back(std::move(group));
  }
  return groups;
}

void keep_centre(LineGroup& group) {
  const auto farthest =
      std::max_element(group.begin(), group.end(),
                       [](const PlaneLine& a, const PlaneLine& b) { return a.offset < b.offset; });
  farthest->offset = std::max(farthest->offset, 0.0);
}

}  // namespace

PartnerSets group_lines(std::span<const PlaneLine> all, double tolerance) {
  PartnerSets sets;
  if (all.empty()) return sets;
  const std::vector<PlaneLine> lines = different_lines(all, tolerance);
  bool any_united = false;
  bool any_intersected = false;
  std::vector<std::uint32_t> waiting(lines.size());
  for (std::uint32_t k = 0; k < lines.size(); ++k) waiting[k] = k;
  while (!waiting.empty()) {
    std::vector<std::uint32_t> members{waiting.front()};
    waiting.erase(waiting.begin());
    for (std::size_t m = 0; m < members.size(); ++m) {
      std::erase_if(waiting, [&](std::uint32_t k) {
        const PairKind kind = kind_of(lines[members[m]], lines[k], tolerance);
        any_united = any_united || kind == PairKind::Unite;
        if (kind != PairKind::Intersect) return false;
        any_intersected = true;
        members.push_back(k);
        return true;
      });
    }
    std::ranges::sort(members);  // nearest partner first
    LineGroup linked;
    for (const std::uint32_t k : members) linked.push_back(lines[k]);
    for (LineGroup& group : groups_of_linked(linked, tolerance)) {
      keep_centre(group);
      sets.groups.push_back(std::move(group));
    }
  }
  sets.kind = any_united && any_intersected ? ClipKind::Mixed
              : any_united                  ? ClipKind::Union
              : any_intersected             ? ClipKind::Intersection
                                            : ClipKind::Flat;
  return sets;
}

std::vector<LineGroup> lines_alone(std::span<const PlaneLine> lines) {
  std::vector<LineGroup> groups;
  for (const PlaneLine& line : lines) {
    groups.push_back({line});
    keep_centre(groups.back());
  }
  return groups;
}

}  // namespace relief
