#include "preprocess/normals/closed_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <vector>

namespace relief {
namespace {

// A mesh without a border may have one point in this many that no triangle has: dragon_vrip_res3
// has 16 of 22,998. Patches of more could have holes of their own.
constexpr std::size_t kPointsPerLone = 100;

/// Triangles connected by edges: a forest whose roots identify the components.
class Pieces {
 public:
  explicit Pieces(std::size_t triangles) : parents_(triangles) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  std::uint32_t root_of(std::uint32_t triangle) {
    while (parents_[triangle] != triangle)
      triangle = parents_[triangle] = parents_[parents_[triangle]];
    return triangle;
  }

  void join(std::uint32_t a, std::uint32_t b) { parents_[root_of(a)] = root_of(b); }

 private:
  std::vector<std::uint32_t> parents_;
};

/// The components of a mesh in which every edge has two triangles.
Pieces join_pieces(const Points& mesh, const MeshEdges& edges) {
  Pieces pieces(mesh.triangles.size());
  for (std::uint32_t p = 0; p < mesh.size(); ++p) {
    const std::span<const EdgeUse> uses = edges.of(p);
    for (std::size_t e = 0; e < uses.size(); e += 2)
      pieces.join(uses[e].triangle, uses[e + 1].triangle);
  }
  return pieces;
}

/// How many of the first `given` points no triangle has.
std::size_t count_lone_points(const Points& mesh, std::size_t given) {
  std::vector<bool> is_corner(mesh.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) is_corner[corner] = true;
  }
  const auto end = is_corner.begin() + static_cast<std::ptrdiff_t>(given);
  return static_cast<std::size_t>(std::count(is_corner.begin(), end, false));
}

/// Six times the volume of each component, at its root.
std::vector<double> volumes_of(const Points& mesh, Pieces& pieces) {
  std::vector<double> volumes(mesh.triangles.size(), 0.0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    // Relative to a point of the same piece: coordinates may be large beside the body.
    const std::uint32_t root = pieces.root_of(t);
    const glm::dvec3 base = mesh.positions[mesh.triangles[root][0]];
    const auto corner = [&](std::size_t c) { return mesh.positions[mesh.triangles[t][c]] - base; };
    volumes[root] += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
  }
  return volumes;
}

/// Returns whether given normals oppose more than a hundredth of the triangles: some do at thin
/// edges or because of noise.
bool has_normals_against(const Points& mesh) {
  if (mesh.normals.empty()) return false;
  std::size_t against = 0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t[0]];
    const glm::dvec3 across = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    glm::dvec3 given(0.0);
    for (const std::uint32_t corner : t) given += glm::dvec3(mesh.normals[corner]);
    if (glm::dot(across, given) < 0.0) ++against;
  }
  return 100 * against > mesh.triangles.size();
}

}  // namespace

bool is_closed_mesh(const Points& mesh, std::size_t given, const MeshEdges& edges) {
  if (mesh.triangles.empty() || !edges.all_have_two()) return false;
  if (count_lone_points(mesh, given) > 0) return false;
  Pieces pieces = join_pieces(mesh, edges);
  const std::vector<double> volumes = volumes_of(mesh, pieces);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (pieces.root_of(t) == t && !(volumes[t] > 0.0)) return false;
  }
  return !has_normals_against(mesh);
}

bool is_borderless_mesh(const Points& mesh, std::size_t given, const MeshEdges& edges) {
  return !mesh.triangles.empty() && !edges.has_border() &&
         kPointsPerLone * count_lone_points(mesh, given) <= given;
}

}  // namespace relief
