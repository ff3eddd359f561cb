#include "common/mesh/orient_triangles.h"

#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "common/mesh/mesh_edges.h"
#include "common/mesh/weld.h"

namespace relief {
namespace {

/// In place of whether a triangle is turned.
constexpr std::uint8_t kNotMet = 2;

/// The triangle beyond an edge.
struct Beyond {
  std::uint32_t triangle = 0;
  bool agrees = true;  ///< it traverses the edge the other way
};

/// Beyond the edges of a triangle, in no stated order.
struct Around {
  std::array<Beyond, 3> edges;
  std::size_t count = 0;
};

std::vector<Around> neighbours_of(const MeshEdges& edges, std::size_t triangles) {
  std::vector<Around> around(triangles);
  edges.for_each_of_two([&](std::uint32_t /*p*/, const EdgeUse& a, const EdgeUse& b) {
    if (a.triangle == b.triangle) return;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      Around& own = around[from.triangle];
      own.edges[own.count++] = {to.triangle, a.forward != b.forward};
    }
  });
  return around;
}

/// Triangles that are connected across edges of two, and which of them must be turned if the first
/// is not.
struct Piece {
  std::vector<std::uint32_t> triangles;
  bool is_mixed = false;  ///< some must be turned
  bool is_closed = true;  ///< no edge is one triangle's alone, or of several
  bool has_sides = true;  ///< unlike a Moebius strip
};

/// Walks over the piece of a triangle. `turned`: of all triangles, or kNotMet.
Piece piece_of(std::uint32_t first, const std::vector<Around>& around,
               std::vector<std::uint8_t>& turned) {
  Piece piece{.triangles = {first}};
  turned[first] = 0;
  for (std::size_t next = 0; next < piece.triangles.size(); ++next) {
    const std::uint32_t t = piece.triangles[next];
    piece.is_mixed = piece.is_mixed || turned[t] == 1;
    piece.is_closed = piece.is_closed && around[t].count == 3;
    for (const Beyond& beyond : std::span(around[t].edges).first(around[t].count)) {
      const std::uint8_t wanted = beyond.agrees ? turned[t] : 1 - turned[t];
      std::uint8_t& other = turned[beyond.triangle];
      if (other == kNotMet) {
        other = wanted;
        piece.triangles.push_back(beyond.triangle);
      } else if (other != wanted) {
        piece.has_sides = false;
      }
    }
  }
  return piece;
}

/// By how much a piece faces outward when its triangles are turned: below 0 for one that all of
/// should be turned once more.
double outward(const Points& mesh, std::span<const Triangle> welded, const Piece& piece,
               const std::vector<std::uint8_t>& turned) {
  double by_normals = 0.0;
  double volume = 0.0;
  double area = 0.0;
  const glm::dvec3 base = mesh.positions[welded[piece.triangles.front()][0]];
  for (const std::uint32_t t : piece.triangles) {
    const double sign = turned[t] == 1 ? -1.0 : 1.0;
    std::array<glm::dvec3, 3> p{};
    for (std::size_t c = 0; c < 3; ++c) p[c] = mesh.positions[welded[t][c]] - base;
    const glm::dvec3 normal = sign * glm::cross(p[1] - p[0], p[2] - p[0]);
    volume += glm::dot(p[0], normal);
    area += sign * glm::length(normal);
    if (mesh.normals.empty()) continue;
    for (const std::uint32_t corner : mesh.triangles[t])
      by_normals += glm::dot(normal, glm::dvec3(mesh.normals[corner]));
  }
  if (by_normals != 0.0) return by_normals;
  return piece.is_closed && volume != 0.0 ? volume : area;
}

/// triangles_to_turn() of a mesh with these edges.
std::vector<std::uint8_t> find_turned(const Points& mesh, std::span<const Triangle> welded,
                                      const MeshEdges& edges) {
  const std::vector<Around> around = neighbours_of(edges, welded.size());
  std::vector<std::uint8_t> turned(welded.size(), kNotMet);
  for (std::uint32_t t = 0; t < welded.size(); ++t) {
    if (turned[t] != kNotMet) continue;
    const Piece piece = piece_of(t, around, turned);
    const bool changes = piece.is_mixed && piece.has_sides;
    const bool all = changes && outward(mesh, welded, piece, turned) < 0.0;
    for (const std::uint32_t own : piece.triangles)
      turned[own] = changes && (turned[own] == 1) != all ? 1 : 0;
  }
  return turned;
}

}  // namespace

std::vector<std::uint8_t> triangles_to_turn(const Points& mesh, std::span<const Triangle> welded) {
  return find_turned(mesh, welded, MeshEdges(mesh.size(), welded));
}

void turn_triangle(Points& mesh, std::size_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
  if (!mesh.corner_texcoords.empty())
    std::swap(mesh.corner_texcoords[triangle][1], mesh.corner_texcoords[triangle][2]);
  if (!mesh.corner_tangents.empty())
    std::swap(mesh.corner_tangents[triangle][1], mesh.corner_tangents[triangle][2]);
}

bool orient_triangles(Points& mesh, std::vector<Triangle>& welded) {
  const MeshEdges edges(mesh.size(), welded);
  if (edges.misoriented() == 0.0) return true;  // most meshes: all agree
  const std::vector<std::uint8_t> turned = find_turned(mesh, welded, edges);
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] == 0) continue;
    turn_triangle(mesh, t);
    std::swap(welded[t][1], welded[t][2]);
  }
  return MeshEdges(mesh.size(), welded).misoriented() < kMaxMisoriented;
}

bool orient_triangles(Points& mesh) {
  std::vector<Triangle> welded = welded_triangles(mesh);
  return orient_triangles(mesh, welded);
}

}  // namespace relief
