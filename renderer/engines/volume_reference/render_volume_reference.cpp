#include "renderer/engines/volume_reference/render_volume_reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume_reference/composite.h"
#include "renderer/frame/film.h"
#include "renderer/volume/placement.h"
#include "renderer/volume/surfaces_beside.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume_reference {
namespace {

using Clock = std::chrono::steady_clock;

FilmPixel film_pixel(const VolumePixel& shown, bool is_encoded) {
  FilmPixel pixel;
  const double alpha = 1.0 - shown.transmittance;
  if (!(alpha > 0.0)) return pixel;
  pixel.colour =
      glm::vec4(glm::dvec4(is_encoded ? decoded(shown.colour, alpha) : shown.colour, alpha));
  const double length = glm::length(shown.normal);
  if (length > 0.0) pixel.normal = glm::vec3(shown.normal / length);
  pixel.depth = static_cast<float>(shown.depth);
  return pixel;
}

struct Drawn {
  Film film;
  std::uint64_t evaluations = 0;
};

/// The tile's part of an image's limits, row by row; none if there are none.
std::vector<float> limits_of(std::span<const float> limits, const Tiling& tiling,
                             const PixelBox& box) {
  std::vector<float> own;
  if (limits.empty()) return own;
  own.resize(kTile * kTile);
  for (std::int64_t y = box.top; y <= box.bottom; ++y) {
    for (std::int64_t x = box.left; x <= box.right; ++x)
      own[static_cast<std::size_t>((y - box.top) * kTile + (x - box.left))] =
          limits[static_cast<std::size_t>(y * tiling.width + x)];
  }
  return own;
}

/// All tiles. `limits`: of the image's pixels, as composite_tile() takes them.
Drawn draw_tiles(const Composition& composition, const TileLists& lists,
                 std::span<const float> limits, bool is_encoded, const Progress& progress) {
  const Tiling& tiling = composition.tiling;
  Drawn drawn;
  drawn.film = {static_cast<std::uint32_t>(tiling.width), static_cast<std::uint32_t>(tiling.height),
                std::vector<FilmPixel>(static_cast<std::size_t>(tiling.width * tiling.height))};
  std::vector<std::uint64_t> evaluations(tiling.count(), 0);
  tbb::parallel_for(std::size_t{0}, tiling.count(), [&](std::size_t tile) {
    if (progress.cancelled() || lists.list(tile).empty()) return;
    const PixelBox box = tiling.box(tile);
    std::vector<VolumePixel> pixels(kTile * kTile);
    evaluations[tile] =
        composite_tile(composition, lists, tile, limits_of(limits, tiling, box), pixels);
    for (std::int64_t y = box.top; y <= box.bottom; ++y) {
      for (std::int64_t x = box.left; x <= box.right; ++x) {
        const auto from = static_cast<std::size_t>((y - box.top) * kTile + (x - box.left));
        drawn.film.pixels[static_cast<std::size_t>(y * tiling.width + x)] =
            film_pixel(pixels[from], is_encoded);
      }
    }
  });
  for (const std::uint64_t count : evaluations) drawn.evaluations += count;
  return drawn;
}

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, std::shared_ptr<EnvironmentCache> environments,
           std::optional<SurfacesBeside> surfaces)
      : model_(std::move(model)),
        environments_(std::move(environments)),
        surfaces_(std::move(surfaces)) {}

  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    const RenderSettings settings = model_.settled(asked);
    SurfacesBeside::Drawn surfaces;
    if (surfaces_) {
      RELIEF_TRY_ASSIGN(surfaces, surfaces_->draw(settings, progress));
    }
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    Drawn drawn;
    std::vector<double> frame_ms;
    for (int i = 0; i < std::max(settings.frames, 1); ++i) {
      const auto start = Clock::now();
      RELIEF_TRY_ASSIGN(drawn, draw(*cloud, view, settings, surfaces, progress));
      if (progress.cancelled()) return interrupted_error();
      frame_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    RenderResult result;
    result.renderer = "CPU";
    result.fragments = drawn.evaluations;
    result.frame_ms = median_of(std::move(frame_ms)) + surfaces.frame_ms;
    result.image = develop(drawn.film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  /// Figure 11 of [Zwicker 2002], with the visibility that the settings choose.
  Result<Drawn> draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
                     const SurfacesBeside::Drawn& surfaces, const Progress& progress) const {
    const VolumeSettings& chosen = settings.volume;
    const std::vector<FootprintRule> rules = model_.footprint_rules(settings, view);
    RELIEF_TRY_ASSIGN(const auto colours, model_.colours(cloud, settings, view, *environments_));
    const std::vector<PlacedSplat> splats = place_splats(cloud, view, rules, progress);
    const SplatOrder order = order_splats(cloud, splats, visibility_of(cloud, chosen.visibility),
                                          ray_camera(view), model_.spacing());
    const Tiling tiling{view.width, view.height};
    const TileLists lists(tiling, splats, order);
    const Composition composition{
        splats,
        colours,
        settings.outputs.normal ? std::span(cloud.normals) : std::span<const glm::vec3>(),
        order,
        composite_rule(chosen, cloud.weight),
        tiling};
    const bool is_encoded = model_.blends_encoded(settings);
    Drawn drawn = draw_tiles(composition, lists, surfaces.limits.covered, is_encoded, progress);
    if (surfaces.film.pixels.empty()) return drawn;
    Drawn beside;
    if (!surfaces.limits.beside.empty())
      beside = draw_tiles(composition, lists, surfaces.limits.beside, is_encoded, progress);
    drawn.film = laid_over(surfaces.film, drawn.film, beside.film);
    drawn.evaluations += beside.evaluations;
    return drawn;
  }

  VolumeModel model_;
  std::shared_ptr<EnvironmentCache> environments_;
  std::optional<SurfacesBeside> surfaces_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  std::optional<SurfacesBeside> surfaces;
  if (has_surfaces(request.model)) {
    RELIEF_TRY_ASSIGN(surfaces, SurfacesBeside::prepare(request));
  }
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(
      VolumeModel(request.model), request.environments, std::move(surfaces)));
}

}  // namespace relief::volume_reference
