#include "renderer/shading/environment/cross_cube.h"

namespace relief {
namespace {

/// Where a face of a cube lies in a cross, in faces, and whether it lies there turned by 180
/// degrees.
struct CrossFace {
  std::size_t column;
  std::size_t row;
  bool turned;
};

/// The faces +X, -X, +Y, -Y, +Z, -Z of a cross that is four faces wide, or four high.
constexpr std::array<CrossFace, 6> kWideCross{
    {{2, 1, false}, {0, 1, false}, {1, 0, true}, {1, 2, true}, {3, 1, false}, {1, 1, false}}};
constexpr std::array<CrossFace, 6> kHighCross{
    {{2, 1, false}, {0, 1, false}, {1, 0, true}, {1, 2, true}, {1, 3, true}, {1, 1, false}}};

/// Which of six images a face of a cube is: ahead, the fifth, is toward -Z.
constexpr std::array<std::size_t, 6> kImageOfFace{0, 1, 2, 3, 5, 4};

/// A face from an image as it is seen from within, which is `texel(column, row)`: OpenGL's faces
/// are seen from outside, which mirrors them.
template <class Texel>
std::vector<glm::vec3> mirrored(std::size_t size, bool turned, const Texel& texel) {
  std::vector<glm::vec3> face;
  face.reserve(size * size);
  for (std::size_t y = 0; y < size; ++y) {
    const std::size_t row = turned ? size - 1 - y : y;
    for (std::size_t x = 0; x < size; ++x) face.push_back(texel(turned ? x : size - 1 - x, row));
  }
  return face;
}

bool is_wide_cross(std::size_t width, std::size_t height) {
  return 3 * width == 4 * height && width % 4 == 0;
}

}  // namespace

bool is_cross(std::size_t width, std::size_t height) {
  return is_wide_cross(width, height) || is_wide_cross(height, width);
}

CubeMap cut_cross(const std::vector<glm::vec3>& texels, std::size_t width, std::size_t height) {
  const bool wide = is_wide_cross(width, height);
  const std::size_t size = width / (wide ? 4 : 3);
  CubeMap cube;
  cube.size = static_cast<std::uint32_t>(size);
  for (std::size_t face = 0; face < 6; ++face) {
    const CrossFace& spot = (wide ? kWideCross : kHighCross)[face];
    cube.faces[face] = mirrored(size, spot.turned, [&](std::size_t column, std::size_t row) {
      return texels[(spot.row * size + row) * width + spot.column * size + column];
    });
  }
  return cube;
}

CubeMap join_faces(const std::array<std::vector<glm::vec3>, 6>& faces, std::size_t size) {
  CubeMap cube;
  cube.size = static_cast<std::uint32_t>(size);
  for (std::size_t face = 0; face < 6; ++face) {
    const std::vector<glm::vec3>& texels = faces[kImageOfFace[face]];
    cube.faces[face] =
        mirrored(size, kWideCross[face].turned,
                 [&](std::size_t column, std::size_t row) { return texels[row * size + column]; });
  }
  return cube;
}

}  // namespace relief
