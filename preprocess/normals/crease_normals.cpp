#include "preprocess/normals/crease_normals.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "preprocess/normals/crease_sides.h"

namespace relief {
namespace {

/// The side of a crease that a point is on, if there is one.
std::optional<CreaseSide> side_of(const OrientedPoint& point,
                                  std::span<const OrientedPoint> around) {
  std::optional<CreaseSide> a = most_shown_side(around, kFewestOfNearSide);
  if (!a) return {};
  const std::optional<CreaseSide> b = farthest_side(around, a->normal);
  if (!b || glm::dot(a->normal, b->normal) > kCreaseTurnCosine) return {};
  if (const auto again = farthest_side(around, b->normal)) a = again;
  const float to_a = glm::dot(point.normal, a->normal);
  const float to_b = glm::dot(point.normal, b->normal);
  if (std::max(to_a, to_b) >= kCreaseSideCosine) return to_a >= to_b ? a : b;
  const auto off = [&](const CreaseSide& side) {
    return std::abs(glm::dot(point.position - side.middle, glm::dvec3(side.normal)));
  };
  return off(*a) <= off(*b) ? a : b;
}

}  // namespace

CreaseNormals find_creases(const std::vector<glm::dvec3>& positions,
                           const std::vector<glm::vec3>& given, const NeighbourGraph& graph) {
  CreaseNormals creases{given, std::vector<std::uint8_t>(given.size(), 0)};
  tbb::parallel_for(std::size_t{0}, given.size(), [&](std::size_t i) {
    bool turns = false;
    for (const std::uint32_t j : graph.of(i))
      turns = turns || glm::dot(given[i], given[j]) < kSlightTurnCosine;
    if (!turns) return;
    std::vector<OrientedPoint> around{{positions[i], given[i]}};
    around.reserve(graph.k + 1);
    for (const std::uint32_t j : graph.of(i)) around.push_back({positions[j], given[j]});
    const std::optional<CreaseSide> side = side_of(around.front(), around);
    if (!side) return;
    creases.normals[i] = side->normal;
    creases.at_crease[i] = 1;
  });
  return creases;
}

}  // namespace relief
