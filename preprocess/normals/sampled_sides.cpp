#include "preprocess/normals/sampled_sides.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <utility>

namespace relief {
namespace {

bool is_within(const Bounds& box, glm::dvec3 p) {
  return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

/// Whether a piece may have points in a box. Its points are about `centre`.
bool reaches(const PieceDipole& piece, glm::dvec3 centre, const Bounds& box) {
  const glm::dvec3 at = centre + glm::dvec3(piece.centre);
  const glm::dvec3 off = at - glm::clamp(at, box.min, box.max);
  return glm::dot(off, off) <= piece.squared_reach;  // farther away than any of its points
}

/// Adds the points of a piece that lie outside a box.
void add_beyond(const Bounds& box, const PiecedSurface& surface, std::size_t piece,
                glm::dvec3 centre, PiecedSurface& rest) {
  const auto begin = static_cast<std::uint32_t>(rest.positions.size());
  for (std::uint32_t i = surface.first[piece]; i < surface.first[piece + 1]; ++i) {
    if (is_within(box, centre + glm::dvec3(surface.positions[i]))) continue;
    rest.positions.push_back(surface.positions[i]);
    rest.area_normals.push_back(surface.area_normals[i]);
  }
  if (rest.positions.size() > begin) rest.first.push_back(begin);
}

}  // namespace

SampledSides::SampledSides(const std::vector<glm::dvec3>& points, std::vector<glm::vec3> normals,
                           PiecedSurface surface, glm::dvec3 centre, float number)
    : tree_(points),
      normals_(std::move(normals)),
      surface_(std::move(surface)),
      dipoles_(dipoles_of(surface_)),
      centre_(centre),
      number_(number) {}

glm::vec3 SampledSides::normal_near(glm::dvec3 position) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  tree_.visit_near(
      position, [&nearest] { return nearest; },
      [&](std::size_t first, std::size_t count) {
        std::array<double, PositionTree::kLeafSize> squared;
        tree_.squared_distances(position, first, squared);
        for (std::size_t m = 0; m < count; ++m) {
          if (squared[m] >= nearest) continue;
          nearest = squared[m];
          found = tree_.index(first + m);
        }
      });
  return normals_[found];
}

Eigen::VectorXf SampledSides::winding_numbers_beyond(const Bounds& box, const SurfacePlaces& places,
                                                     glm::dvec3 centre) const {
  SurfacePlaces own = places;
  for (glm::vec3& place : own.positions) place += glm::vec3(centre - centre_);
  Eigen::VectorXf whole = Eigen::VectorXf::Ones(static_cast<Eigen::Index>(dipoles_.size()));
  PiecedSurface cut;
  for (std::size_t piece = 0; piece < dipoles_.size(); ++piece) {
    if (!reaches(dipoles_[piece], centre_, box)) continue;
    whole[static_cast<Eigen::Index>(piece)] = 0.0F;
    add_beyond(box, surface_, piece, centre_, cut);
  }
  cut.first.push_back(static_cast<std::uint32_t>(cut.positions.size()));
  const auto parts = Eigen::VectorXf::Ones(static_cast<Eigen::Index>(cut.count()));
  return total_winding_numbers(surface_, dipoles_, whole, own) +
         total_winding_numbers(cut, dipoles_of(cut), parts, own);
}

}  // namespace relief
