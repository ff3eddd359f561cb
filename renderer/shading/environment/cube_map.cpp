#include "renderer/shading/environment/cube_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace relief {
namespace {

/// A face, and where on it in [-1, 1].
struct FacePosition {
  std::size_t face = 0;
  glm::dvec2 st{0.0};
};

FacePosition face_position_of(glm::dvec3 d) {
  const glm::dvec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z)
    return d.x > 0.0 ? FacePosition{0, {-d.z / a.x, -d.y / a.x}}
                     : FacePosition{1, {d.z / a.x, -d.y / a.x}};
  if (a.y >= a.z)
    return d.y > 0.0 ? FacePosition{2, {d.x / a.y, d.z / a.y}}
                     : FacePosition{3, {d.x / a.y, -d.z / a.y}};
  return d.z > 0.0 ? FacePosition{4, {d.x / a.z, -d.y / a.z}}
                   : FacePosition{5, {-d.x / a.z, -d.y / a.z}};
}

/// A texel's value; of one beyond the face's edge, that of the nearest texel of the next face.
glm::vec3 texel(const CubeMap& cube, std::size_t face, std::int64_t x, std::int64_t y) {
  const auto size = static_cast<std::int64_t>(cube.size);
  if (x < 0 || y < 0 || x >= size || y >= size) {
    const auto half = static_cast<double>(size) / 2.0;
    const FacePosition beyond =
        face_position_of(cube_direction(face, {(static_cast<double>(x) + 0.5) / half - 1.0,
                                               (static_cast<double>(y) + 0.5) / half - 1.0}));
    face = beyond.face;
    const glm::dvec2 at = glm::floor((beyond.st + 1.0) * half);
    x = std::clamp(static_cast<std::int64_t>(at.x), std::int64_t{0}, size - 1);
    y = std::clamp(static_cast<std::int64_t>(at.y), std::int64_t{0}, size - 1);
  }
  return cube.faces[face][static_cast<std::size_t>(y * size + x)];
}

}  // namespace

glm::dvec3 cube_direction(std::size_t face, glm::dvec2 st) {
  switch (face) {
    case 0:
      return {1.0, -st.y, -st.x};
    case 1:
      return {-1.0, -st.y, st.x};
    case 2:
      return {st.x, 1.0, st.y};
    case 3:
      return {st.x, -1.0, -st.y};
    case 4:
      return {st.x, -st.y, 1.0};
    default:
      return {-st.x, -st.y, -1.0};
  }
}

glm::vec3 look_up(const CubeMap& cube, glm::dvec3 direction) {
  const FacePosition position = face_position_of(direction);
  const glm::dvec2 at = (position.st + 1.0) * (cube.size / 2.0) - 0.5;
  const glm::dvec2 corner = glm::floor(at);
  const glm::vec2 part(at - corner);
  const auto x = static_cast<std::int64_t>(corner.x);
  const auto y = static_cast<std::int64_t>(corner.y);
  const glm::vec3 low =
      glm::mix(texel(cube, position.face, x, y), texel(cube, position.face, x + 1, y), part.x);
  const glm::vec3 high = glm::mix(texel(cube, position.face, x, y + 1),
                                  texel(cube, position.face, x + 1, y + 1), part.x);
  return glm::mix(low, high, part.y);
}

}  // namespace relief
