// The image that an engine on the CPU fills, and how it becomes an Image.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "common/image/image.h"
#include "renderer/settings.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/shading/environment/standing_cube.h"
#include "renderer/view/view.h"

namespace relief {

/// One pixel's outputs. What a pixel that shows nothing has is the default.
struct FilmPixel {
  glm::vec4 colour{0.0F};                                ///< linear, premultiplied; alpha: coverage
  glm::vec3 normal{0.0F};                                ///< world, unit, or 0
  float depth = std::numeric_limits<float>::infinity();  ///< along the view axis
  glm::vec2 uv{0.0F};                                    ///< grid coordinates on the patch
  std::uint32_t patch = 0;                               ///< patch id + 1
  std::uint8_t clip = 0;                                 ///< ClipKind of the splat in front
};

/// The pixels of an image, row-major, top row first.
struct Film {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<FilmPixel> pixels;
  /// Whether what lies behind is blended as encoded sRGB, as all viewers of 3D Gaussians do: a
  /// faint Gaussian over black is as dark as its authors saw it.
  bool blends_encoded = false;
};

/// What lies behind the model: the environment if it has a cube, else a colour, else nothing.
struct Surroundings {
  StandingCube environment;
  std::optional<glm::vec3> background;  ///< linear; none: alpha stays the coverage
};

/// The environment, if the image has one and a background for it to be. Fails if it can't be
/// read.
Result<Surroundings> surroundings_of(const RenderSettings& settings,
                                     EnvironmentCache& environments);

/// Puts the surroundings behind the film and makes an image with the outputs that are on, in the
/// channels that common/image.h names; all of them are float. `covered` counts the pixels with a
/// coverage above 0.
[[nodiscard]] Image develop(const Film& film, const Surroundings& surroundings, const View& view,
                            const Outputs& outputs, std::uint64_t& covered);

}  // namespace relief
