#include "renderer/engines/surfel/select_surfels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <numeric>

#include "renderer/view/cull_mode.h"

namespace relief::surfel {
namespace {

/// Surfels that one task looks at.
constexpr std::size_t kBlock = 8192;

/// Heights at the rim below this, in pixels, are not worth a curved surfel.
constexpr float kLeastHeight = 0.125F;

/// The camera in single precision, relative to the eye, world axes.
struct Eye {
  std::array<glm::vec4, 5> planes{};  ///< of the frustum, inward: dot(xyz, p) + w >= 0 within
  glm::vec3 forward{0.0F};
  float pixel = 0.0F;  ///< height at depth 1, or anywhere of an orthographic camera
  bool orthographic = false;
};

Eye make_eye(const View& view) {
  const glm::dmat3 to_world = glm::transpose(view.rotation);
  Eye eye;
  eye.orthographic = view.orthographic;
  eye.forward = glm::vec3(to_world * glm::dvec3(0.0, 0.0, -1.0));
  eye.pixel = static_cast<float>(pixel_at(view, 1.0));
  const auto plane = [&](glm::dvec3 inward, double offset) {
    const double length = glm::length(inward);
    return glm::vec4(glm::dvec4(to_world * inward / length, offset / length));
  };
  const glm::dvec2 low = view.middle - glm::dvec2(view.slope_x, view.slope_y);
  const glm::dvec2 high = view.middle + glm::dvec2(view.slope_x, view.slope_y);
  if (view.orthographic) {
    eye.planes = {plane({1, 0, 0}, -low.x), plane({-1, 0, 0}, high.x), plane({0, 1, 0}, -low.y),
                  plane({0, -1, 0}, high.y), plane({0, 0, -1}, 0.0)};
  } else {  // a point at depth d is within if low d <= x <= high d
    eye.planes = {plane({1, 0, low.x}, 0.0), plane({-1, 0, -high.x}, 0.0),
                  plane({0, 1, low.y}, 0.0), plane({0, -1, -high.y}, 0.0), plane({0, 0, -1}, 0.0)};
  }
  return eye;
}

/// A surfel as the eye sees it.
struct Seen {
  glm::vec3 place{0.0F};  ///< of its centre, from the eye
  float depth = 0.0F;
  float away = 0.0F;      ///< how far its normal points away from the eye, times `distance`
  float distance = 1.0F;  ///< to its farthest point; orthographic: 1
};

Seen look_at(const SurfelSet& set, std::size_t k, const View& view, const Eye& eye) {
  Seen seen;
  seen.place = glm::vec3(set.positions[k] - view.eye);
  seen.depth = glm::dot(eye.forward, seen.place);
  seen.away = glm::dot(set.normals[k], eye.orthographic ? eye.forward : seen.place);
  if (!eye.orthographic) seen.distance = glm::length(seen.place) + set.radii[k];
  return seen;
}

bool is_in_image(const Seen& seen, float radius, const Eye& eye) {
  return std::all_of(eye.planes.begin(), eye.planes.end(), [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), seen.place) + plane.w >= -kBentReach * radius;
  });
}

bool is_curved(const Seen& seen, float slope, float radius, const Eye& eye, SurfelCurved curved) {
  if (curved == SurfelCurved::None || slope == 0.0F) return false;
  if (curved == SurfelCurved::All) return true;
  const float pixel = eye.orthographic ? eye.pixel : eye.pixel * std::max(seen.depth, 0.0F);
  // On a sphere, discs with a rim slope of s stick out where they lean by less than 2 s.
  return std::abs(seen.away) <= 2.0F * slope * seen.distance &&
         0.5F * slope * radius >= kLeastHeight * pixel;
}

/// A surfel that is drawn.
struct Choice {
  shared::DrawnSurfel drawn;
  float depth;
  SurfelKind kind;
};

shared::DrawnSurfel drawn_at(glm::vec3 place, std::size_t number) {
  return {std::bit_cast<std::uint32_t>(place.x), std::bit_cast<std::uint32_t>(place.y),
          std::bit_cast<std::uint32_t>(place.z), static_cast<std::uint32_t>(number)};
}

/// What decides it, for all tasks.
struct Selection {
  const SurfelSet& set;
  const View& view;
  const SelectionRule& rule;
  Eye eye;
};

/// Hands those of `slots` that are drawn to `take`, in their order.
template <class Take>
void find_in(std::span<const std::uint32_t> slots, const Selection& by, const Take& take) {
  const SelectionRule& rule = by.rule;
  for (const std::uint32_t k : slots) {
    const Seen seen = look_at(by.set, k, by.view, by.eye);
    const float radius = by.set.radii[k];
    if (!is_in_image(seen, radius, by.eye)) continue;
    const float slope = rim_slope(by.set.bends[k]);
    const bool curved = is_curved(seen, slope, radius, by.eye, rule.curved);
    const float turned = curved ? slope * seen.distance : 0.0F;
    if (rule.hides_backs && seen.away >= turned) continue;
    const bool clipped = rule.all_clipped || (k < rule.clipped.size() && rule.clipped[k] != 0);
    take(Choice{drawn_at(seen.place, k), seen.depth, {curved, clipped}});
  }
}

/// The slots that the tree leaves.
std::vector<std::uint32_t> cut_slots(const SurfelSet& set, const View& view,
                                     const SelectionRule& rule) {
  const SphereCut cut = cut_sphere_tree(
      set.tree, view, {.backs = rule.hides_backs, .pixels = rule.pixels_per_surfel});
  std::vector<std::uint32_t> slots;
  const auto add_runs = [&slots](const std::vector<SurfelRun>& runs, std::size_t offset) {
    for (const SurfelRun& run : runs) {
      slots.resize(slots.size() + run.count);
      std::iota(slots.end() - run.count, slots.end(),
                static_cast<std::uint32_t>(offset + run.first));
    }
  };
  add_runs(cut.surfels, 0);
  add_runs(cut.nodes, set.own);
  return slots;
}

/// What `add(choice, found)` makes of those that are drawn: one `Found` a block, in the blocks'
/// order.
template <class Found, class Add>
std::vector<Found> find_by_block(std::span<const std::uint32_t> slots, const Selection& by,
                                 const Add& add) {
  std::vector<Found> blocks((slots.size() + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    const std::size_t first = b * kBlock;
    find_in(slots.subspan(first, std::min(kBlock, slots.size() - first)), by,
            [&](const Choice& choice) { add(choice, blocks[b]); });
  });
  return blocks;
}

/// Back to front. Neighbours of one kind make a batch.
DrawnSurfels sorted_by_depth(std::span<const std::uint32_t> slots, const Selection& by) {
  const auto found = find_by_block<std::vector<Choice>>(
      slots, by, [](const Choice& choice, auto& block) { block.push_back(choice); });
  std::vector<Choice> all;
  for (const std::vector<Choice>& block : found) all.insert(all.end(), block.begin(), block.end());
  std::ranges::sort(all, [](const Choice& a, const Choice& b) {
    return a.depth != b.depth ? a.depth > b.depth : a.drawn.number < b.drawn.number;
  });
  DrawnSurfels drawn;
  drawn.list.reserve(all.size());
  for (const Choice& choice : all) {
    if (drawn.batches.empty() || drawn.batches.back().kind != choice.kind)
      drawn.batches.push_back({choice.kind, static_cast<std::uint32_t>(drawn.list.size()), 0});
    ++drawn.batches.back().count;
    drawn.list.push_back(choice.drawn);
  }
  return drawn;
}

/// Kind by kind, by slot: what each block found is copied to where the blocks before end.
DrawnSurfels grouped_by_kind(std::span<const std::uint32_t> slots, const Selection& by) {
  using Lists = std::array<std::vector<shared::DrawnSurfel>, kSurfelKinds.size()>;
  const auto found = find_by_block<Lists>(slots, by, [](const Choice& choice, Lists& lists) {
    lists[choice.kind.index()].push_back(choice.drawn);
  });
  DrawnSurfels drawn;
  std::size_t end = 0;
  std::vector<std::array<std::size_t, kSurfelKinds.size()>> places(found.size());
  for (const SurfelKind& kind : kSurfelKinds) {
    const std::size_t first = end;
    for (std::size_t b = 0; b < found.size(); ++b) {
      places[b][kind.index()] = end;
      end += found[b][kind.index()].size();
    }
    if (end > first) {
      drawn.batches.push_back(
          {kind, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)});
    }
  }
  drawn.list.resize(end);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t b) {
    for (std::size_t kind = 0; kind < kSurfelKinds.size(); ++kind) {
      const auto place = static_cast<std::ptrdiff_t>(places[b][kind]);
      std::ranges::copy(found[b][kind], drawn.list.begin() + place);
    }
  });
  return drawn;
}

}  // namespace

DrawnSurfels select_surfels(const SurfelSet& set, const View& view, const SelectionRule& rule) {
  const Selection by{set, view, rule, make_eye(view)};
  const std::vector<std::uint32_t> slots = cut_slots(set, view, rule);
  return rule.sorted ? sorted_by_depth(slots, by) : grouped_by_kind(slots, by);
}

bool sees_from_outside(const SurfelSet& set, const View& view) {
  return relief::sees_from_outside(view, Body{set.bounds, {}});
}

}  // namespace relief::surfel
