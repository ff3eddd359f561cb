#include "renderer/surfels/texture_frames.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/neighbours/neighbours.h"

namespace relief {
namespace {

constexpr std::uint32_t kNeighbours = 12;
/// Neighbours farther than so many radii are not where the texture is drawn.
constexpr double kGradientReach = 4.0;
/// Pairs of the nearest so many propose a map: 28 of them.
constexpr std::size_t kProposers = 8;
/// At least so many neighbours must agree with a map: any two do, whichever chart they are on.
constexpr int kFewestAgreeing = 3;
/// How far off the map a neighbour's coordinates may be, over what the map's gradient gives for its
/// distance: charts bend and stretch, while jumps over seams are many times that.
constexpr double kTolerance = 0.25;

/// A neighbour: its offset in the tangent plane, in radii, and its coordinates less the surfel's.
struct Shift {
  glm::dvec2 offset{0.0};
  glm::dvec2 change{0.0};
};

bool agrees(const glm::dmat2& map, const Shift& shift) {
  const double size = std::sqrt(glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]));
  return glm::distance(map * shift.offset, shift.change) <=
         kTolerance * size * glm::length(shift.offset);
}

/// A map, how many neighbours agree with it, and its squared size.
struct Proposal {
  glm::dmat2 map{0.0};
  int agreeing = 0;
  double size = 0.0;
};

/// Maps more than twice as steep as the flattest that enough neighbours agree with lead over a
/// seam: there a step of the coordinates lies within a step of the surface. Many agree with a steep
/// map, whose tolerance is wide.
constexpr double kMostOfFlattest = 2.0 * 2.0;  // of squared sizes

Proposal rate(const glm::dmat2& map, std::span<const Shift> shifts) {
  Proposal proposal{map, 0, glm::dot(map[0], map[0]) + glm::dot(map[1], map[1])};
  for (const Shift& shift : shifts) proposal.agreeing += agrees(map, shift) ? 1 : 0;
  return proposal;
}

/// The map by least squares from the neighbours that agree with `map`; `map` if they are on a line.
glm::dmat2 refit(const glm::dmat2& map, std::span<const Shift> shifts) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  glm::dvec2 by_x(0.0);
  glm::dvec2 by_y(0.0);
  for (const Shift& shift : shifts) {
    if (!agrees(map, shift)) continue;
    xx += shift.offset.x * shift.offset.x;
    xy += shift.offset.x * shift.offset.y;
    yy += shift.offset.y * shift.offset.y;
    by_x += shift.offset.x * shift.change;
    by_y += shift.offset.y * shift.change;
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-4 * (xx + yy) * (xx + yy))) return map;
  return {(yy * by_x - xy * by_y) / determinant, (xx * by_y - xy * by_x) / determinant};
}

/// The maps of all pairs of near neighbours that enough others agree with.
using Proposals = std::array<Proposal, kProposers*(kProposers - 1) / 2>;

std::size_t propose(std::span<const Shift> shifts, Proposals& proposals) {
  std::size_t count = 0;
  const std::size_t proposers = std::min(shifts.size(), kProposers);
  for (std::size_t b = 1; b < proposers; ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const glm::dvec2 p = shifts[a].offset;
      const glm::dvec2 q = shifts[b].offset;
      const double determinant = p.x * q.y - p.y * q.x;
      if (!(std::abs(determinant) > 0.2 * glm::length(p) * glm::length(q))) continue;
      const glm::dmat2 map((q.y * shifts[a].change - p.y * shifts[b].change) / determinant,
                           (p.x * shifts[b].change - q.x * shifts[a].change) / determinant);
      proposals[count] = rate(map, shifts);
      if (proposals[count].agreeing >= kFewestAgreeing) ++count;
    }
  }
  return count;
}

glm::dmat2 find_map(std::span<const Shift> shifts) {
  Proposals all;
  const auto proposals = std::span(all).first(propose(shifts, all));
  if (proposals.empty()) return glm::dmat2(0.0);
  const auto flattest = std::ranges::min_element(proposals, {}, &Proposal::size);
  Proposal best = *flattest;
  for (const Proposal& proposal : proposals) {
    if (proposal.size > kMostOfFlattest * flattest->size) continue;
    if (proposal.agreeing > best.agreeing) best = proposal;
  }
  glm::dmat2 map = best.map;
  for (int round = 0; round < 2; ++round) map = refit(map, shifts);
  return map;
}

}  // namespace

Result<std::vector<glm::mat2>> find_texture_gradients(std::span<const glm::dvec3> positions,
                                                      std::span<const glm::vec2> texcoords,
                                                      std::span<const SurfelFrame> frames,
                                                      std::span<const double> radii,
                                                      Progress& progress) {
  progress.begin_stage("surfel textures", positions.size());
  const NeighbourGraph graph = find_neighbours({positions.begin(), positions.end()}, kNeighbours);
  if (progress.cancelled()) return interrupted_error();
  std::vector<glm::mat2> gradients(positions.size(), glm::mat2(0.0F));
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, positions.size(), 1024), [&](const Range& range) {
    if (progress.cancelled()) return;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const double radius = radii[k];
      if (!std::isfinite(radius) || !(radius > 0.0)) continue;
      std::array<Shift, kNeighbours> shifts;
      std::size_t count = 0;
      for (const std::uint32_t j : graph.of(k)) {
        const glm::dvec3 offset = (positions[j] - positions[k]) / radius;
        if (!(glm::dot(offset, offset) < kGradientReach * kGradientReach)) break;
        const glm::dvec2 change = glm::dvec2(texcoords[j]) - glm::dvec2(texcoords[k]);
        if (!std::isfinite(change.x) || !std::isfinite(change.y)) continue;
        shifts[count++] = {{glm::dot(offset, frames[k].u), glm::dot(offset, frames[k].v)}, change};
      }
      const glm::mat2 gradient(find_map(std::span(shifts).first(count)) / radius);
      const float sum = gradient[0].x + gradient[0].y + gradient[1].x + gradient[1].y;
      if (std::isfinite(sum)) gradients[k] = gradient;
    }
    progress.advance(range.size());
  });
  if (progress.cancelled()) return interrupted_error();
  return gradients;
}

}  // namespace relief
