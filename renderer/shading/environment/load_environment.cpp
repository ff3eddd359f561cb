// Making cube maps: from images, or the built-in one.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "common/image/image_io.h"
#include "renderer/shading/environment/cross_cube.h"
#include "renderer/shading/environment/cube_map.h"
#include "renderer/shading/environment/environment_files.h"
#include "renderer/shading/environment/make_cube.h"

namespace relief {
namespace {

constexpr std::uint32_t kSmallestFace = 64;
constexpr std::uint32_t kLargestFace = 2048;  // 300 MB of floats; images of 8192 texels
constexpr std::uint32_t kBuiltInFace = 512;
constexpr float kBrightest = 65000.0F;  // below the largest half float, 65504

/// A sky over a ground, each side in a tint of its own, with dark grid lines (as Figure 6 of paper
/// 001) in which a wrong normal shows.
CubeMap make_grid_cube() {
  constexpr std::array<glm::vec3, 6> kTints{
      glm::vec3(1.0F, 0.55F, 0.45F), {0.5F, 0.85F, 1.0F},         glm::vec3(1.0F),
      {0.9F, 0.75F, 0.55F},          glm::vec3(0.6F, 1.0F, 0.6F), {1.0F, 0.9F, 0.45F}};
  constexpr double kLines = 8.0;                    // per face
  constexpr double kThickness = 0.06;               // of a field
  constexpr double kWidth = kLines / kBuiltInFace;  // a texel, in fields
  return make_cube(kBuiltInFace, [&](std::size_t face, glm::dvec2 st) {
    const double up = glm::normalize(cube_direction(face, st)).y;
    const auto sky = static_cast<float>(glm::smoothstep(-0.1, 0.1, up));
    const glm::vec3 over = glm::mix(glm::vec3(0.85F), glm::vec3(0.5F, 0.65F, 0.9F),
                                    static_cast<float>(std::max(up, 0.0)));
    const glm::vec3 light = glm::mix(glm::vec3(0.25F, 0.22F, 0.2F), over, sky);
    const glm::dvec2 field = (st + 1.0) / 2.0 * kLines;
    const glm::dvec2 to_line = glm::abs(field - glm::round(field));
    const glm::dvec2 clear = glm::smoothstep(glm::dvec2(kThickness / 2.0 - kWidth),
                                             glm::dvec2(kThickness / 2.0 + kWidth), to_line);
    return light * kTints[face] * glm::mix(0.04F, 1.0F, static_cast<float>(clear.x * clear.y));
  });
}

/// The colour of an image, interleaved, fit for half floats.
Result<std::vector<glm::vec3>> colour_of(const Image& image, const std::filesystem::path& path) {
  const Channel* grey = image.find("Y");
  const Channel* red = image.find("R");
  const Channel* green = image.find("G");
  const Channel* blue = image.find("B");
  if (red == nullptr || green == nullptr || blue == nullptr) red = green = blue = grey;
  if (red == nullptr) {
    return make_error("{}: has no colour channels (R, G, B or Y); it can't be an environment",
                      path.string());
  }
  const auto finite = [](float v) {
    return std::isfinite(v) ? std::clamp(v, 0.0F, kBrightest) : 0.0F;
  };
  std::vector<glm::vec3> texels(red->values.size());
  for (std::size_t k = 0; k < texels.size(); ++k)
    texels[k] = {finite(red->values[k]), finite(green->values[k]), finite(blue->values[k])};
  return texels;
}

/// An equirectangular image. Its sides wrap around, its poles do not.
struct Panorama {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::vector<glm::vec3> texels;

  [[nodiscard]] const glm::vec3& at(std::int64_t x, std::int64_t y) const {
    const std::int64_t row = std::clamp(y, std::int64_t{0}, height - 1);
    return texels[static_cast<std::size_t>(row * width + (x + width) % width)];
  }

  /// Bilinear, from a direction of length 1.
  [[nodiscard]] glm::vec3 look_up(glm::dvec3 d) const {
    const double pi = glm::pi<double>();
    const glm::dvec2 position(0.5 + std::atan2(d.x, -d.z) / (2.0 * pi),
                              std::acos(std::clamp(d.y, -1.0, 1.0)) / pi);
    const glm::dvec2 at_texel = position * glm::dvec2(width, height) - 0.5;
    const glm::dvec2 corner = glm::floor(at_texel);
    const glm::vec2 part(at_texel - corner);
    const auto x = static_cast<std::int64_t>(corner.x);
    const auto y = static_cast<std::int64_t>(corner.y);
    return glm::mix(glm::mix(at(x, y), at(x + 1, y), part.x),
                    glm::mix(at(x, y + 1), at(x + 1, y + 1), part.x), part.y);
  }
};

/// Of surroundings that have `texels` over 90 degrees; `look_up` takes a direction of length 1.
template <class LookUp>
CubeMap resample(std::uint32_t texels, const LookUp& look_up) {
  const std::uint32_t size = std::bit_ceil(std::clamp(texels, kSmallestFace, kLargestFace));
  // Where the image is finer than the largest face, a texel is the mean of positions within it.
  const int positions = std::max(static_cast<int>((texels + size - 1) / size), 1);
  return make_cube(size, [&](std::size_t face, glm::dvec2 st) {
    glm::vec3 sum(0.0F);
    for (int v = 0; v < positions; ++v) {
      for (int u = 0; u < positions; ++u) {
        const glm::dvec2 within = (glm::dvec2(u, v) + 0.5) / static_cast<double>(positions) - 0.5;
        sum += look_up(
            glm::normalize(cube_direction(face, st + within * 2.0 / static_cast<double>(size))));
      }
    }
    return sum / static_cast<float>(positions * positions);
  });
}

/// The cube itself if OpenGL filters its size well, or else one of another size.
CubeMap fit(CubeMap cube) {
  if (std::has_single_bit(cube.size) && cube.size <= kLargestFace) return cube;
  return resample(cube.size, [&cube](glm::dvec3 d) { return look_up(cube, d); });
}

Result<CubeMap> load_faces(const std::vector<std::filesystem::path>& files) {
  std::array<std::vector<glm::vec3>, 6> faces;
  std::uint32_t size = 0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    RELIEF_TRY_ASSIGN(const auto image, read_image(files[k]));
    if (image.width != image.height) {
      return make_error("{}: its {}x{} pixels are not square, as the face of a cube must be",
                        files[k].string(), image.width, image.height);
    }
    if (k > 0 && image.width != size) {
      return make_error("{}: its {}x{} pixels are not the {}x{} of {}; all six faces have one size",
                        files[k].string(), image.width, image.height, size, size,
                        files.front().string());
    }
    size = image.width;
    RELIEF_TRY_ASSIGN(auto texels, colour_of(image, files[k]));
    faces[k] = std::move(texels);
  }
  return fit(join_faces(faces, size));
}

}  // namespace

Result<CubeMap> load_environment(const std::filesystem::path& path) {
  if (path.empty()) return make_grid_cube();
  RELIEF_TRY_ASSIGN(const auto files, environment_files(path));
  if (files.size() > 1) return load_faces(files);
  RELIEF_TRY_ASSIGN(const auto image, read_image(path));
  RELIEF_TRY_ASSIGN(auto texels, colour_of(image, path));
  if (is_cross(image.width, image.height)) return fit(cut_cross(texels, image.width, image.height));
  const Panorama panorama{image.width, image.height, std::move(texels)};
  // A face spans 90 of the image's 180 degrees of height.
  return resample(image.height / 2, [&panorama](glm::dvec3 d) { return panorama.look_up(d); });
}

}  // namespace relief
