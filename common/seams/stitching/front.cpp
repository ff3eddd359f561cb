#include "common/seams/stitching/front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace relief {
namespace {

std::uint64_t key_of(Front::Vertex from, Front::Vertex to) {
  return (std::uint64_t{from} << 32U) | to;
}

}  // namespace

AnglesAbout::AnglesAbout(glm::dvec3 middle, glm::dvec3 normal, glm::dvec3 first) : middle_(middle) {
  const glm::dvec3 along = first - middle;
  x_ = along - glm::dot(along, normal) * normal;
  y_ = glm::cross(normal, x_);
}

double AnglesAbout::to(glm::dvec3 position) const {
  const glm::dvec3 d = position - middle_;
  const double x = glm::dot(d, x_);
  const double y = glm::dot(d, y_);
  const double sum = std::abs(x) + std::abs(y);
  if (sum == 0.0) return 0.0;
  const double t = y / sum;
  if (x < 0.0) return 2.0 - t;
  return t < 0.0 ? 4.0 + t : t;
}

TriangleShape shape_of(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 normal = glm::cross(a - b, c - b);
  const double area = glm::length(normal);
  return {normal / area, area,
          glm::distance(a, b) * glm::distance(b, c) * glm::distance(c, a) / (2.0 * area)};
}

Front::Front(const BorderMesh& mesh)
    : mesh_(mesh),
      vertices_(mesh.vertices),
      corners_(vertices_.size()),
      used_(mesh.edges.size()),
      added_(vertices_.size()) {
  for (const BorderEdge& edge : mesh.edges) {
    ++corners_[edge.from].end_used;  // how many, first
    corners_[edge.from].has_triangle = true;
    corners_[edge.to].has_triangle = true;
  }
  std::uint32_t first = 0;
  for (Corner& corner : corners_) {
    corner.first_used = first;
    first += std::exchange(corner.end_used, first);
  }
  for (const BorderEdge& edge : mesh.edges) used_[corners_[edge.from].end_used++] = edge.to;
  for (const BorderEdge& edge : mesh.edges) {
    if (!is_used(edge.to, edge.from)) open(edge.from, edge.to, edge.normal);
  }
}

const Front::Edge* Front::find(Vertex from, Vertex to) const {
  for (const Edge& edge : corners_[from].edges) {
    if (edge.outward && edge.other == to) return &edge;
  }
  return nullptr;
}

bool Front::is_used(Vertex from, Vertex to) const {
  const Corner& corner = corners_[from];
  for (std::uint32_t k = corner.first_used; k < corner.end_used; ++k) {
    if (used_[k] == to) return true;
  }
  return corner.has_added && added_.find(key_of(from, to)) != FlatMap::kNone;
}

void Front::use(Vertex from, Vertex to) {
  added_.insert(key_of(from, to), 0);
  corners_[from].has_added = true;
}

void Front::attach(Vertex from, Vertex to, Vertex apex) {
  const glm::dvec3 p = vertices_[to].position;
  const glm::dvec3 normal =
      glm::normalize(glm::cross(vertices_[from].position - p, vertices_[apex].position - p));
  triangles_.push_back({to, from, apex});
  corners_[apex].has_triangle = true;
  use(to, from);
  close(from, to);
  const std::array<std::array<Vertex, 2>, 2> added{{{from, apex}, {apex, to}}};
  for (const auto& [begin, end] : added) {
    use(begin, end);
    if (is_open(end, begin)) {
      close(end, begin);
    } else {
      open(begin, end, normal);
    }
  }
}

void Front::open(Vertex from, Vertex to, glm::dvec3 normal) {
  corners_[from].edges.push_back({to, true, normal});
  corners_[to].edges.push_back({from, false, normal});
  const double length = glm::distance(vertices_[from].position, vertices_[to].position);
  for (const Vertex v : {from, to}) corners_[v].longest = std::max(corners_[v].longest, length);
  longest_ = std::max(longest_, length);
}

void Front::close(Vertex from, Vertex to) {
  std::erase_if(corners_[from].edges, [to](const Edge& e) { return e.outward && e.other == to; });
  std::erase_if(corners_[to].edges,
                [from](const Edge& e) { return !e.outward && e.other == from; });
}

}  // namespace relief
