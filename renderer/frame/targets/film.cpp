#include "renderer/frame/targets/film.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "common/image/srgb.h"

namespace relief {
namespace {

/// A channel whose values are `value_of(pixel)`.
template <class ValueOf>
Channel make_channel(const char* name, const Film& film, const ValueOf& value_of) {
  Channel channel{name, ChannelType::Float, {}};
  channel.values.reserve(film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) channel.values.push_back(value_of(pixel));
  return channel;
}

/// Not clamped: what lies behind may be brighter than white.
float encoded(float light) {
  return light > 1.0F ? 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F : srgb_from_linear(light);
}

/// A premultiplied colour (linear) of some coverage over another, mixed as encoded sRGB.
glm::vec3 mixed_encoded(glm::vec4 colour, glm::vec3 behind) {
  if (!(colour.a > 0.0F)) return behind;
  glm::vec3 mixed(0.0F);
  for (glm::length_t c = 0; c < 3; ++c)
    mixed[c] = linear_from_srgb(colour.a * encoded(colour[c] / colour.a) +
                                (1.0F - colour.a) * encoded(behind[c]));
  return mixed;
}

/// The model's colour over what lies behind it.
std::vector<glm::vec3> composite(const Film& film, const Surroundings& surroundings,
                                 const View& view) {
  std::vector<glm::vec3> colours(film.pixels.size());
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const FilmPixel& pixel = film.pixels[k];
    colours[k] = glm::vec3(pixel.colour);
    if (!surroundings.background || pixel.colour.a >= 1.0F) continue;
    glm::vec3 behind = *surroundings.background;
    if (surroundings.environment.cube != nullptr) {
      const std::size_t x = k % film.width;
      const std::size_t row = k / film.width;  // from the top; the window's are from the bottom
      const glm::dvec2 middle(static_cast<double>(x) + 0.5,
                              static_cast<double>(film.height - row) - 0.5);
      behind = look_up(surroundings.environment, ray_through(view, middle));
    }
    colours[k] = film.blends_encoded ? mixed_encoded(pixel.colour, behind)
                                     : colours[k] + (1.0F - pixel.colour.a) * behind;
  }
  return colours;
}

}  // namespace

Result<Surroundings> surroundings_of(const RenderSettings& settings,
                                     EnvironmentCache& environments) {
  Surroundings surroundings{{}, settings.background};
  if (!has_backdrop(settings)) return surroundings;
  RELIEF_TRY_ASSIGN(const auto cube, environments.get(settings.environment));
  surroundings.environment = {cube, environment_from_world(settings)};
  return surroundings;
}

Image develop(const Film& film, const Surroundings& surroundings, const View& view,
              const Outputs& outputs, std::uint64_t& covered) {
  Image image{film.width, film.height, {}};
  const std::vector<glm::vec3> colours = composite(film, surroundings, view);
  const char* const names[] = {"R", "G", "B"};
  for (glm::length_t c = 0; c < 3; ++c) {
    Channel channel{names[c], ChannelType::Float, {}};
    channel.values.reserve(colours.size());
    for (const glm::vec3& colour : colours) channel.values.push_back(colour[c]);
    image.channels.push_back(std::move(channel));
  }
  const bool opaque = surroundings.background.has_value();
  image.channels.push_back(
      make_channel("A", film, [opaque](const FilmPixel& p) { return opaque ? 1.0F : p.colour.a; }));
  const auto add = [&](const char* name, const auto& value_of) {
    image.channels.push_back(make_channel(name, film, value_of));
  };
  if (outputs.normal) {
    add("N.X", [](const FilmPixel& p) { return p.normal.x; });
    add("N.Y", [](const FilmPixel& p) { return p.normal.y; });
    add("N.Z", [](const FilmPixel& p) { return p.normal.z; });
  }
  if (outputs.depth) add("Z", [](const FilmPixel& p) { return p.depth; });
  if (outputs.uv) {
    add("UV.U", [](const FilmPixel& p) { return p.uv.x; });
    add("UV.V", [](const FilmPixel& p) { return p.uv.y; });
  }
  if (outputs.patch_id) {
    add("patch", [](const FilmPixel& p) { return static_cast<float>(p.patch); });
    image.channels.back().type = ChannelType::Uint;
  }
  if (outputs.clip) {
    add("clip", [](const FilmPixel& p) { return static_cast<float>(p.clip); });
    image.channels.back().type = ChannelType::Uint;
  }
  covered = 0;
  for (const FilmPixel& pixel : film.pixels) covered += pixel.colour.a > 0.0F ? 1 : 0;
  return image;
}

}  // namespace relief
