#include "common/seams/front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

std::uint64_t key_of(Front::Vertex from, Front::Vertex to) {
  return (std::uint64_t{from} << 32U) | to;
}

}  // namespace

AnglesAbout::AnglesAbout(const BorderVertex& middle, glm::dvec3 first) : middle_(middle.position) {
  const glm::dvec3 along = first - middle.position;
  x_ = along - glm::dot(along, middle.normal) * middle.normal;
  y_ = glm::cross(middle.normal, x_);
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
      at_(vertices_.size()),
      has_triangle_(vertices_.size(), 0) {
  used_.reserve(2 * mesh.edges.size());
  for (const BorderEdge& edge : mesh.edges) {
    used_.insert(key_of(edge.from, edge.to));
    has_triangle_[edge.from] = 1;
    has_triangle_[edge.to] = 1;
  }
  for (const BorderEdge& edge : mesh.edges) {
    if (!is_used(edge.to, edge.from)) open(edge.from, edge.to, edge.normal);
  }
}

const Front::Edge* Front::find(Vertex from, Vertex to) const {
  for (const Edge& edge : at_[from]) {
    if (edge.outward && edge.other == to) return &edge;
  }
  return nullptr;
}

bool Front::is_used(Vertex from, Vertex to) const {
  return used_.contains(key_of(from, to));
}

void Front::attach(Vertex from, Vertex to, Vertex apex) {
  const glm::dvec3 p = vertices_[to].position;
  const glm::dvec3 normal =
      glm::normalize(glm::cross(vertices_[from].position - p, vertices_[apex].position - p));
  triangles_.push_back({to, from, apex});
  has_triangle_[apex] = 1;
  used_.insert(key_of(to, from));
  close(from, to);
  const std::array<std::array<Vertex, 2>, 2> added{{{from, apex}, {apex, to}}};
  for (const auto& [begin, end] : added) {
    used_.insert(key_of(begin, end));
    if (is_open(end, begin)) {
      close(end, begin);
    } else {
      open(begin, end, normal);
    }
  }
}

void Front::open(Vertex from, Vertex to, glm::dvec3 normal) {
  at_[from].push_back({to, true, normal});
  at_[to].push_back({from, false, normal});
}

void Front::close(Vertex from, Vertex to) {
  std::erase_if(at_[from], [to](const Edge& e) { return e.outward && e.other == to; });
  std::erase_if(at_[to], [from](const Edge& e) { return !e.outward && e.other == from; });
}

}  // namespace relief
