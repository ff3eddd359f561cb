#include "common/mesh/mesh_tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace relief {
namespace {

bool has_direction(glm::dvec3 v) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 1e-12;
}

/// Returns `v` projected into the plane of the unit vector `normal`, as a unit vector; 0 if nothing
/// is left.
glm::dvec3 in_plane(glm::dvec3 v, glm::dvec3 normal) {
  const glm::dvec3 flat = v - glm::dot(v, normal) * normal;
  // A vector along the normal leaves only rounding errors.
  return has_direction(flat) && glm::length(flat) > 1e-6 * glm::length(v) ? glm::normalize(flat)
                                                                          : glm::dvec3(0.0);
}

/// The direction in which u grows over a triangle, any length, and whether the texture is mirrored.
struct Direction {
  glm::dvec3 tangent{0.0};
  double handedness = 0.0;  ///< 0: its texture coordinates span no area
};

Direction direction_of(const Points& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const CornerTexcoords at = texcoords_of(mesh, triangle);
  const glm::dvec2 b = glm::dvec2(at[1]) - glm::dvec2(at[0]);
  const glm::dvec2 c = glm::dvec2(at[2]) - glm::dvec2(at[0]);
  const double area = b.x * c.y - b.y * c.x;
  if (!std::isfinite(area) || area == 0.0) return {};
  const glm::dvec3 ab = mesh.positions[t[1]] - mesh.positions[t[0]];
  const glm::dvec3 ac = mesh.positions[t[2]] - mesh.positions[t[0]];
  const double sign = area > 0.0 ? 1.0 : -1.0;
  const glm::dvec3 along_u = sign * (c.y * ab - b.y * ac);
  if (!has_direction(along_u)) return {};
  return {glm::normalize(along_u), sign};
}

/// Returns the angle at corner `c` between the triangle's edges, projected into the plane of the
/// normal there.
double angle_at(const Points& mesh, const Triangle& t, std::size_t c, glm::dvec3 normal) {
  const glm::dvec3 at = mesh.positions[t[c]];
  const glm::dvec3 one = in_plane(mesh.positions[t[(c + 1) % 3]] - at, normal);
  const glm::dvec3 other = in_plane(mesh.positions[t[(c + 2) % 3]] - at, normal);
  return std::acos(std::clamp(glm::dot(one, other), -1.0, 1.0));
}

/// The key of a triangle's corner: corners with equal keys share a tangent.
struct CornerKey {
  std::uint32_t point = 0;
  glm::vec2 texcoord{0.0F};
  double handedness = 0.0;
  std::size_t triangle = 0;
  std::size_t corner = 0;

  [[nodiscard]] auto shared() const { return std::tie(point, texcoord.x, texcoord.y, handedness); }
};

/// Returns the corners of triangles with a normal map and a direction, grouped by shared tangent.
std::vector<CornerKey> sorted_corners(const Points& mesh,
                                      const std::vector<Direction>& directions) {
  std::vector<CornerKey> corners;
  for (std::size_t t = 0; t < directions.size(); ++t) {
    if (directions[t].handedness == 0.0) continue;
    const CornerTexcoords at = texcoords_of(mesh, t);
    for (std::size_t c = 0; c < 3; ++c)
      corners.push_back({mesh.triangles[t][c], at[c], directions[t].handedness, t, c});
  }
  std::sort(corners.begin(), corners.end(), [](const CornerKey& a, const CornerKey& b) {
    return std::tuple(a.shared(), a.triangle, a.corner) <
           std::tuple(b.shared(), b.triangle, b.corner);
  });
  return corners;
}

/// Tangents from texture coordinates.
void smooth_tangents(const Points& mesh, const std::vector<glm::vec3>& normals,
                     std::vector<CornerTangents>& tangents) {
  std::vector<Direction> directions(mesh.triangles.size());
  for (std::size_t t = 0; t < directions.size(); ++t) {
    if (triangle_normal_map(mesh, t) != nullptr) directions[t] = direction_of(mesh, t);
  }
  const std::vector<CornerKey> corners = sorted_corners(mesh, directions);
  for (std::size_t begin = 0; begin < corners.size();) {
    const glm::dvec3 normal(normals[corners[begin].point]);
    glm::dvec3 sum(0.0);
    std::size_t end = begin;
    do {
      const CornerKey& key = corners[end];
      sum += angle_at(mesh, mesh.triangles[key.triangle], key.corner, normal) *
             in_plane(directions[key.triangle].tangent, normal);
      ++end;
    } while (end < corners.size() && corners[end].shared() == corners[begin].shared());
    const glm::vec3 mean(in_plane(sum, normal));
    for (; begin < end; ++begin) {
      const CornerKey& key = corners[begin];
      tangents[key.triangle][key.corner] = {mean, static_cast<float>(key.handedness)};
    }
  }
}

bool is_given(const CornerTangents& corners) {
  return std::all_of(corners.begin(), corners.end(), [](glm::vec4 tangent) {
    return std::isfinite(tangent.w) && tangent.w != 0.0F && has_direction(glm::vec3(tangent));
  });
}

}  // namespace

const MeshNormalMap* triangle_normal_map(const Points& mesh, std::size_t triangle) {
  if (mesh.triangle_materials.empty()) return nullptr;
  const std::uint32_t material = mesh.triangle_materials[triangle];
  if (material == kNoMaterial || mesh.materials[material].normals.texture == nullptr)
    return nullptr;
  return &mesh.materials[material].normals;
}

bool has_normal_maps(const Points& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (triangle_normal_map(mesh, t) != nullptr) return true;
  }
  return false;
}

std::vector<CornerTangents> tangents_of(const Points& mesh, const std::vector<glm::vec3>& normals) {
  std::vector<CornerTangents> tangents(mesh.triangles.size(), CornerTangents{});
  smooth_tangents(mesh, normals, tangents);
  if (mesh.corner_tangents.empty()) return tangents;
  for (std::size_t t = 0; t < tangents.size(); ++t) {
    const CornerTangents& given = mesh.corner_tangents[t];
    if (triangle_normal_map(mesh, t) == nullptr || !is_given(given)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 normal(normals[mesh.triangles[t][c]]);
      tangents[t][c] = {glm::vec3(in_plane(glm::vec3(given[c]), normal)),
                        given[c].w > 0.0F ? 1.0F : -1.0F};
    }
  }
  return tangents;
}

TangentFrame frame_at(const CornerTangents& tangents, const std::array<glm::vec3, 3>& normals,
                      glm::dvec3 weights) {
  TangentFrame frame;
  double handedness = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double weight = weights[static_cast<glm::length_t>(c)];
    frame.normal += weight * glm::dvec3(normals[c]);
    frame.tangent += weight * glm::dvec3(tangents[c]);
    handedness += weight * tangents[c].w;
  }
  frame.bitangent = (handedness < 0.0 ? -1.0 : 1.0) * glm::cross(frame.normal, frame.tangent);
  return frame;
}

glm::dvec3 perturbed_normal(const TangentFrame& frame, glm::vec3 from_map, float scale) {
  const auto unit = [](glm::dvec3 v) {
    return has_direction(v) ? glm::normalize(v) : glm::dvec3(0.0);
  };
  if (!has_direction(frame.tangent)) return unit(frame.normal);
  const glm::dvec3 v = double{scale * from_map.x} * frame.tangent +
                       double{scale * from_map.y} * frame.bitangent +
                       double{from_map.z} * frame.normal;
  return has_direction(v) ? glm::normalize(v) : unit(frame.normal);
}

}  // namespace relief
