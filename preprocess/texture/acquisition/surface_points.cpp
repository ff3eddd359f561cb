#include "preprocess/texture/acquisition/surface_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relief {
namespace {

glm::vec2 texcoord_at(const Points& mesh, std::size_t triangle, std::size_t corner) {
  if (mesh.texcoords.empty()) return glm::vec2(0.0F);
  return mesh.corner_texcoords.empty() ? mesh.texcoords[mesh.triangles[triangle][corner]]
                                       : mesh.corner_texcoords[triangle][corner];
}

/// Twice the area, along the normal.
glm::dvec3 area_vector(const Points& mesh, const Triangle& t) {
  const glm::dvec3 a = mesh.positions[t[0]];
  return glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

/// Numbers in [0, 1)^2 that differ from triangle to triangle (the finaliser of SplitMix64), so that
/// the single points of small triangles are not all at one relative position.
glm::dvec2 offset_of(std::uint64_t triangle) {
  std::uint64_t h = (triangle + 1) * 0x9E3779B97F4A7C15U;
  h = (h ^ (h >> 30U)) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 27U)) * 0x94D049BB133111EBU;
  h ^= h >> 31U;
  constexpr double kScale = 1.0 / 4294967296.0;
  return {static_cast<double>(h >> 32U) * kScale, static_cast<double>(h & 0xFFFFFFFFU) * kScale};
}

/// The i-th barycentric weights in a triangle: the R2 sequence in the square, whose upper half is
/// turned onto the lower one.
glm::dvec3 weights_of(glm::dvec2 offset, std::size_t i) {
  // 1/p and 1/p^2 with p the real root of p^3 = p + 1.
  constexpr glm::dvec2 kStep{0.7548776662466927, 0.5698402909980532};
  glm::dvec2 s = glm::fract(offset + static_cast<double>(i) * kStep);
  if (s.x + s.y > 1.0) s = 1.0 - s;
  return {1.0 - s.x - s.y, s.x, s.y};
}

void put_point(const Points& mesh, std::size_t triangle, glm::dvec3 w, std::size_t index,
               SurfacePoints& out) {
  const Triangle& t = mesh.triangles[triangle];
  const glm::vec3 weight(w);
  // Relative to a corner: at UTM size a weighted sum of positions would lose digits.
  const glm::dvec3 origin = mesh.positions[t[0]];
  out.positions[index] =
      origin + w.y * (mesh.positions[t[1]] - origin) + w.z * (mesh.positions[t[2]] - origin);
  out.texcoords[index] = weight.x * texcoord_at(mesh, triangle, 0) +
                         weight.y * texcoord_at(mesh, triangle, 1) +
                         weight.z * texcoord_at(mesh, triangle, 2);
  const glm::vec3 normal =
      weight.x * mesh.normals[t[0]] + weight.y * mesh.normals[t[1]] + weight.z * mesh.normals[t[2]];
  const float length = glm::length(normal);
  // Normals that cancel each other leave the triangle's own.
  out.normals[index] =
      length > 1e-3F ? normal / length : glm::vec3(glm::normalize(area_vector(mesh, t)));
}

}  // namespace

SurfaceArea area_of(const Points& mesh) {
  SurfaceArea area;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    area.world += 0.5 * glm::length(area_vector(mesh, mesh.triangles[i]));
    const glm::dvec2 a = texcoord_at(mesh, i, 0);
    const glm::dvec2 b = glm::dvec2(texcoord_at(mesh, i, 1)) - a;
    const glm::dvec2 c = glm::dvec2(texcoord_at(mesh, i, 2)) - a;
    area.texture += 0.5 * std::abs(b.x * c.y - b.y * c.x);
  }
  return area;
}

SurfacePoints spread_over_triangles(const Points& mesh, std::size_t count) {
  const double area = area_of(mesh).world;
  assert(area > 0.0 && std::isfinite(area) && "callers refuse meshes without an area");
  // Point i stands for the area from i to i + 1 shares; it belongs to the triangle that its middle
  // falls into when the triangles are laid side by side.
  std::vector<std::size_t> first(mesh.triangles.size() + 1, 0);
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += 0.5 * glm::length(area_vector(mesh, mesh.triangles[t]));
    const double index = std::ceil(sum / area * static_cast<double>(count) - 0.5);
    first[t + 1] = static_cast<std::size_t>(glm::clamp(index, 0.0, static_cast<double>(count)));
  }
  SurfacePoints out;
  out.positions.resize(first.back());
  out.normals.resize(first.back());
  out.texcoords.resize(first.back());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size()),
                    [&](const auto& range) {
                      for (std::size_t t = range.begin(); t != range.end(); ++t) {
                        const glm::dvec2 offset = offset_of(t);
                        for (std::size_t i = first[t]; i < first[t + 1]; ++i) {
                          put_point(mesh, t, weights_of(offset, i - first[t]), i, out);
                        }
                      }
                    });
  return out;
}

}  // namespace relief
