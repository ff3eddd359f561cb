#include "renderer/volume/surfaces_beside.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "renderer/engine_registry.h"

namespace relief {
namespace {

constexpr float kEverywhere = std::numeric_limits<float>::infinity();

/// The settings that draw the surfaces alone.
RenderSettings of_surfaces(RenderSettings settings, const std::string& engine) {
  settings.engine = engine;
  settings.background.reset();  // the alpha is their coverage
  settings.eye_dome = 0.0;
  settings.outputs.depth = true;
  settings.count_fragments = false;
  settings.explain = false;
  return settings;
}

/// Puts a channel, if it is there, where `member(pixel)` refers to.
template <class Member>
void read_channel(const Image& image, std::string_view name, Film& film, const Member& member) {
  const Channel* const channel = image.find(name);
  if (channel == nullptr) return;
  for (std::size_t k = 0; k < film.pixels.size(); ++k)
    member(film.pixels[k]) =
        static_cast<std::remove_reference_t<decltype(member(film.pixels[k]))>>(channel->values[k]);
}

Film film_of(const Image& image) {
  Film film{image.width, image.height,
            std::vector<FilmPixel>(std::size_t{image.width} * image.height)};
  read_channel(image, "R", film, [](FilmPixel& p) -> float& { return p.colour.r; });
  read_channel(image, "G", film, [](FilmPixel& p) -> float& { return p.colour.g; });
  read_channel(image, "B", film, [](FilmPixel& p) -> float& { return p.colour.b; });
  read_channel(image, "A", film, [](FilmPixel& p) -> float& { return p.colour.a; });
  read_channel(image, "N.X", film, [](FilmPixel& p) -> float& { return p.normal.x; });
  read_channel(image, "N.Y", film, [](FilmPixel& p) -> float& { return p.normal.y; });
  read_channel(image, "N.Z", film, [](FilmPixel& p) -> float& { return p.normal.z; });
  read_channel(image, "Z", film, [](FilmPixel& p) -> float& { return p.depth; });
  read_channel(image, "UV.U", film, [](FilmPixel& p) -> float& { return p.uv.x; });
  read_channel(image, "UV.V", film, [](FilmPixel& p) -> float& { return p.uv.y; });
  read_channel(image, "patch", film, [](FilmPixel& p) -> std::uint32_t& { return p.patch; });
  return film;
}

/// The nearest depth in the pixels around one.
float nearest_around(const Film& film, std::size_t pixel) {
  const auto x = static_cast<std::int64_t>(pixel % film.width);
  const auto y = static_cast<std::int64_t>(pixel / film.width);
  float nearest = kEverywhere;
  for (std::int64_t j = std::max<std::int64_t>(y - 1, 0);
       j <= std::min<std::int64_t>(y + 1, std::int64_t{film.height} - 1); ++j) {
    for (std::int64_t i = std::max<std::int64_t>(x - 1, 0);
         i <= std::min<std::int64_t>(x + 1, std::int64_t{film.width} - 1); ++i)
      nearest = std::min(nearest, film.pixels[static_cast<std::size_t>(j * film.width + i)].depth);
  }
  return nearest;
}

FilmPixel laid_over(const FilmPixel& surface, const FilmPixel& covered, const FilmPixel& beside) {
  const float share = std::min(surface.colour.a, 1.0F);
  if (!(share > 0.0F)) return covered;  // up to an infinite depth
  FilmPixel pixel = std::isfinite(covered.depth)   ? covered
                    : std::isfinite(surface.depth) ? surface
                                                   : beside;
  const glm::vec3 light = share * glm::vec3(covered.colour) +
                          (1.0F - covered.colour.a) * glm::vec3(surface.colour) +
                          (1.0F - share) * glm::vec3(beside.colour);
  pixel.colour = glm::vec4(light, share + (1.0F - share) * beside.colour.a);
  return pixel;
}

}  // namespace

DepthLimits depth_limits(const Film& surfaces) {
  DepthLimits limits;
  const std::size_t count = surfaces.pixels.size();
  limits.covered.resize(count, kEverywhere);
  for (std::size_t k = 0; k < count; ++k) {
    const FilmPixel& pixel = surfaces.pixels[k];
    if (!(pixel.colour.a > 0.0F)) continue;
    limits.covered[k] = std::isfinite(pixel.depth) ? pixel.depth : nearest_around(surfaces, k);
    if (pixel.colour.a >= 1.0F) continue;
    limits.beside.resize(count, -kEverywhere);
    limits.beside[k] = kEverywhere;
  }
  return limits;
}

Film laid_over(const Film& surfaces, const Film& covered, const Film& beside) {
  Film film{surfaces.width, surfaces.height, {}};
  film.pixels.reserve(surfaces.pixels.size());
  for (std::size_t k = 0; k < surfaces.pixels.size(); ++k) {
    film.pixels.push_back(laid_over(surfaces.pixels[k], covered.pixels[k],
                                    beside.pixels.empty() ? FilmPixel() : beside.pixels[k]));
  }
  return film;
}

bool has_surfaces(const RenderModel& model) {
  const PatchModel* const patches = model.find<PatchModel>();
  return (patches != nullptr && !patches->patches.empty()) || model.has(ModelForm::Mesh);
}

Result<SurfacesBeside> SurfacesBeside::prepare(const PrepareRequest& request) {
  const EngineEntry* const kernels = find_engine(request.views.front().engine);
  assert(kernels != nullptr && "an engine of the registry");
  const EngineEntry* const entry = find_engine(kernels->surfaces_by);
  assert(entry != nullptr && "an engine of the registry");
  std::vector<RenderSettings> views;
  views.reserve(request.views.size());
  for (const RenderSettings& view : request.views) views.push_back(of_surfaces(view, entry->name));
  RELIEF_TRY_ASSIGN(auto prepared, entry->prepare({.model = request.model,
                                                   .views = views,
                                                   .opengl = request.opengl,
                                                   .environments = request.environments,
                                                   .levels = request.levels}));
  return SurfacesBeside(entry->name, std::move(prepared));
}

Result<SurfacesBeside::Drawn> SurfacesBeside::draw(const RenderSettings& settings,
                                                   Progress& progress) {
  RELIEF_TRY_ASSIGN(const RenderResult result,
                    prepared_->render(of_surfaces(settings, engine_), progress));
  Drawn drawn{film_of(result.image), {}, result.frame_ms};
  drawn.limits = depth_limits(drawn.film);
  return drawn;
}

Result<Image> SurfacesBeside::probe(const RenderSettings& settings, std::uint32_t x,
                                    std::uint32_t y) {
  return prepared_->probe(of_surfaces(settings, engine_), x, y);
}

}  // namespace relief
