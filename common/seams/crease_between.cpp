#include "common/seams/crease_between.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/mesh/creases.h"

namespace relief {
namespace {

// A crease turns the normal by this many times as much as the surface bends beside it.
constexpr double kCreaseContrast = 3.0;

// But a bore bends along its rim, not across it: where a sample has the normal of the plane through
// it within 10 degrees, and bends by less than half a radian a cell, it is on no round edge.
constexpr double kPlaneCosine = 0.985;
constexpr double kBendOfPlane = 0.5;
// Such samples may be on a wedge of 15 degrees. Sharper ones are two sides of a thin wall.
constexpr double kSharpestWedge = -0.966;

/// Whether the surface has a crease between two samples: a turn that is not that of a round
/// feature.
bool is_crease(const BorderVertex& a, const BorderVertex& b) {
  if (glm::dot(a.plane_normal, b.plane_normal) > kCreaseCosine) return false;
  if (is_plane(a) && is_plane(b)) return true;
  const double spacings = glm::distance(a.position, b.position) / std::min(a.spacing, b.spacing);
  const double beside = std::max(a.bend, b.bend) * std::max(spacings, 1.0);
  return glm::distance(a.plane_normal, b.plane_normal) > kCreaseContrast * beside;
}

/// Whether two vertices are on plane faces that turn by about 80 degrees or more. Of faces that are
/// shaded smooth it was tried, too: normals of the Buddha went from 6.3 to 6.8 degrees off, holes
/// of a low-polygon elephant from 975 to 1,312 pixels.
bool are_at_edge(const BorderVertex& a, const BorderVertex& b) {
  return glm::dot(a.normal, b.normal) < kRightEdge && is_plane(a) && is_plane(b) &&
         glm::dot(a.plane_normal, b.plane_normal) > kSharpestWedge;
}

}  // namespace

bool is_plane(const BorderVertex& v) {
  return v.bend < kBendOfPlane && glm::dot(v.normal, v.plane_normal) > kPlaneCosine;
}

bool meet_at_crease(const BorderVertex& a, const BorderVertex& b) {
  const double sharpest = is_plane(a) && is_plane(b) ? kSharpestWedge : -kCreaseCosine;
  return is_crease(a, b) && glm::dot(a.plane_normal, b.plane_normal) > sharpest;
}

std::optional<glm::dvec3> outward_at_edge(const BorderVertex& a, const BorderVertex& b,
                                          const BorderVertex& c) {
  if (!are_at_edge(a, b) && !are_at_edge(b, c) && !are_at_edge(c, a)) return {};
  const auto are_of_one_face = [](const BorderVertex& v, const BorderVertex& w) {
    return glm::dot(v.normal, w.normal) > kCreaseCosine;
  };
  glm::dvec3 sum = a.normal;
  if (!are_of_one_face(a, b)) sum += b.normal;
  if (!are_of_one_face(a, c) && !are_of_one_face(b, c)) sum += c.normal;
  return glm::normalize(sum);
}

}  // namespace relief
