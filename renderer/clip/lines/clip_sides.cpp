#include "renderer/clip/lines/clip_sides.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// Partners of one surface: normals within 30 degrees, and the other's centre as near to the plane
/// as a quarter of the mean radius times two.
bool on_one_surface(const Disc& a, const Disc& b) {
  constexpr double kCosine = 0.866;
  constexpr double kNear = 0.25;
  return glm::dot(a.normal, b.normal) > kCosine &&
         std::abs(glm::dot(b.centre - a.centre, a.normal)) < kNear * (a.radius + b.radius);
}

}  // namespace

std::vector<std::uint8_t> concave_edges(const DiscTree& tree, std::span<const Partner> partners) {
  std::vector<std::uint8_t> concave(partners.size());
  for (std::size_t p = 0; p < partners.size(); ++p) {
    const Disc& disc = tree.discs()[partners[p].slot];
    double sines = 0.0;
    for (const Partner& other : partners) {
      const double distance = glm::length(other.centre);
      if (distance > 0.0 && on_one_surface(disc, tree.discs()[other.slot]))
        sines += (other.above + other.splat_above) / distance;
    }
    concave[p] = sines > 0.0 ? 1 : 0;
  }
  return concave;
}

}  // namespace relief
