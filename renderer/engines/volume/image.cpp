#include "renderer/engines/volume/image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/volume/volume_model.h"
#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

std::vector<glm::vec4> read_texels(const Gl& gl, const Texture& texture, std::size_t texels) {
  std::vector<glm::vec4> values(texels);
  gl.GetTextureImage(texture.id(), 0, GL_RGBA, GL_FLOAT,
                     static_cast<GLsizei>(std::min<std::size_t>(
                         texels * sizeof(glm::vec4), std::numeric_limits<GLsizei>::max())),
                     values.data());
  return values;
}

FilmPixel film_pixel(glm::vec4 colour, glm::vec4 surface, bool is_encoded) {
  FilmPixel pixel;
  const float alpha = 1.0F - colour.a;
  if (!(alpha > 0.0F)) return pixel;
  const glm::vec3 light(colour);
  pixel.colour = glm::vec4(
      is_encoded ? glm::vec3(decoded(glm::dvec3(light), static_cast<double>(alpha))) : light,
      alpha);
  const float length = glm::length(glm::vec3(surface));
  if (length > 0.0F) pixel.normal = glm::vec3(surface) / length;
  pixel.depth = surface.w;
  return pixel;
}

}  // namespace

Result<VolumeTargets> make_volume_targets(const Gl& gl, std::uint32_t width, std::uint32_t height,
                                          Features features) {
  const std::uint32_t largest = largest_target(gl);
  if (width == 0 || height == 0 || width > largest || height > largest) {
    return make_error("an image of {}x{} pixels can't be drawn: this OpenGL allows 1 to {} a side",
                      width, height, largest);
  }
  Texture colour = make_attachment(gl, "volume colour", GL_RGBA32F, width, height);
  std::optional<Texture> surface;
  if (features.has(RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH))
    surface = make_attachment(gl, "volume surface", GL_RGBA32F, width, height);
  Framebuffer framebuffer =
      make_framebuffer(gl, "volume", nullptr,
                       {{RELIEF_VOLUME_OUT_COLOUR, &colour},
                        {RELIEF_VOLUME_OUT_SURFACE, surface ? &*surface : nullptr}});
  RELIEF_TRY(check_errors(gl, "the image"));
  return VolumeTargets{width, height, std::move(colour), std::move(surface),
                       std::move(framebuffer)};
}

void clear_volume_targets(const Gl& gl, const VolumeTargets& targets) {
  const std::array<GLfloat, 4> nothing{0.0F, 0.0F, 0.0F, 1.0F};
  const std::array<GLfloat, 4> nowhere{0.0F, 0.0F, 0.0F, std::numeric_limits<GLfloat>::infinity()};
  const GLuint id = targets.framebuffer.id();
  gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_VOLUME_OUT_COLOUR, nothing.data());
  if (targets.surface)
    gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_VOLUME_OUT_SURFACE, nowhere.data());
}

Texture make_limits(const Gl& gl, std::uint32_t width, std::uint32_t height,
                    std::span<const float> depths) {
  std::vector<float> rows(depths.size());  // the bottom row first
  for (std::size_t y = 0; y < height; ++y) {
    const auto row = depths.subspan((height - 1 - y) * width, width);
    std::copy(row.begin(), row.end(), rows.begin() + static_cast<std::ptrdiff_t>(y * width));
  }
  Texture texture = make_attachment(gl, "volume limits", GL_R32F, width, height);
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height), GL_RED, GL_FLOAT, rows.data());
  return texture;
}

Film read_film(const Gl& gl, const VolumeTargets& targets, bool is_encoded) {
  const std::size_t count = std::size_t{targets.width} * targets.height;
  const std::vector<glm::vec4> colours = read_texels(gl, targets.colour, count);
  std::vector<glm::vec4> surfaces;
  if (targets.surface) surfaces = read_texels(gl, *targets.surface, count);
  Film film{targets.width, targets.height, std::vector<FilmPixel>(count), is_encoded};
  const glm::vec4 nowhere(0.0F, 0.0F, 0.0F, std::numeric_limits<float>::infinity());
  tbb::parallel_for(std::uint32_t{0}, targets.height, [&](std::uint32_t y) {
    const std::size_t from = std::size_t{targets.height - 1 - y} * targets.width;
    for (std::size_t x = 0; x < targets.width; ++x) {
      film.pixels[std::size_t{y} * targets.width + x] = film_pixel(
          colours[from + x], surfaces.empty() ? nowhere : surfaces[from + x], is_encoded);
    }
  });
  return film;
}

}  // namespace relief::volume
