#include "tests/experiments/textured_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "common/cross.h"

namespace relief::experiment {
namespace {

constexpr std::uint32_t kSamples = 8;  // along each side of a pixel

/// What a sample sees.
struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  glm::vec2 texcoord{0.0F};
};

glm::dvec3 to_screen(glm::dvec3 p, const Camera& camera, const glm::dmat3& rotation, double side) {
  const glm::dvec3 eye = rotation * (p - camera.eye);
  const double focal = 0.5 * side / std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  return {0.5 * side + focal * eye.x / -eye.z, 0.5 * side - focal * eye.y / -eye.z, -eye.z};
}

void rasterise(const glm::dvec3 (&p)[3], const CornerTexcoords& texcoords, std::int64_t side,
               std::vector<Hit>& hits) {
  const double area = cross(glm::dvec2(p[1] - p[0]), glm::dvec2(p[2] - p[0]));
  if (area == 0.0) return;
  const auto clamp = [&](double v) {
    return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(side)));
  };
  const auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
  for (std::int64_t y = clamp(std::floor(low_y)); y < clamp(std::ceil(high_y)); ++y) {
    for (std::int64_t x = clamp(std::floor(low_x)); x < clamp(std::ceil(high_x)); ++x) {
      const glm::dvec2 q(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      glm::dvec3 w(cross(glm::dvec2(p[1]) - q, glm::dvec2(p[2]) - q),
                   cross(glm::dvec2(p[2]) - q, glm::dvec2(p[0]) - q),
                   cross(glm::dvec2(p[0]) - q, glm::dvec2(p[1]) - q));
      w /= area;
      if (w.x < 0.0 || w.y < 0.0 || w.z < 0.0) continue;
      w = glm::dvec3(w.x / p[0].z, w.y / p[1].z, w.z / p[2].z);
      const double depth = 1.0 / (w.x + w.y + w.z);
      Hit& hit = hits[static_cast<std::size_t>(y * side + x)];
      if (depth >= hit.depth) continue;
      const glm::vec3 weight(w * depth);
      hit = {depth, weight.x * texcoords[0] + weight.y * texcoords[1] + weight.z * texcoords[2]};
    }
  }
}

std::vector<Hit> find_hits(const Points& mesh, const Camera& camera, std::uint32_t side) {
  std::vector<Hit> hits(std::size_t{side} * side);
  const glm::dmat3 rotation = view_rotation(camera);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    glm::dvec3 p[3];
    CornerTexcoords texcoords{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      p[c] = to_screen(mesh.positions[v], camera, rotation, side);
      texcoords[c] =
          mesh.corner_texcoords.empty() ? mesh.texcoords[v] : mesh.corner_texcoords[t][c];
    }
    if (p[0].z > 0.0 && p[1].z > 0.0 && p[2].z > 0.0) rasterise(p, texcoords, side, hits);
  }
  return hits;
}

}  // namespace

Truths render_truth(const Points& mesh, const ContinuousTexture& texture, const Camera& camera,
                    std::uint32_t side) {
  const std::uint32_t fine = side * kSamples;
  const std::vector<Hit> hits = find_hits(mesh, camera, fine);
  return filter_samples(side, kSamples, [&](glm::dvec2 place) {
    const auto x = static_cast<std::int64_t>(std::floor(place.x * kSamples));
    const auto y = static_cast<std::int64_t>(std::floor(place.y * kSamples));
    if (x < 0 || y < 0 || x >= fine || y >= fine) return glm::dvec4(0.0);
    const Hit& hit = hits[static_cast<std::size_t>(y * fine + x)];
    if (!std::isfinite(hit.depth)) return glm::dvec4(0.0);
    return glm::dvec4(glm::dvec3(texture.at(hit.texcoord)), 1.0);
  });
}

}  // namespace relief::experiment
