#include "renderer/engines/volume_reference/render_volume_reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume_reference/composite.h"
#include "renderer/frame/film.h"
#include "renderer/volume/placement.h"
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

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, std::shared_ptr<EnvironmentCache> environments)
      : model_(std::move(model)), environments_(std::move(environments)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    Drawn drawn;
    std::vector<double> frame_ms;
    for (int i = 0; i < std::max(settings.frames, 1); ++i) {
      const auto start = Clock::now();
      RELIEF_TRY_ASSIGN(drawn, draw(*cloud, view, settings, progress));
      if (progress.cancelled()) return interrupted_error();
      frame_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    RenderResult result;
    result.renderer = "CPU";
    result.fragments = drawn.evaluations;
    result.frame_ms = median_of(std::move(frame_ms));
    drawn.film.blends_encoded = model_.blends_encoded(settings);
    result.image = develop(drawn.film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  /// Figure 11 of [Zwicker 2002], with the visibility that the settings choose.
  Result<Drawn> draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
                     const Progress& progress) const {
    const VolumeSettings& chosen = settings.volume;
    const FootprintRule rule = footprint_rule(chosen, cloud.weight, model_.is_antialiased(), view);
    RELIEF_TRY_ASSIGN(const auto colours, model_.colours(cloud, settings, view, *environments_));
    const std::vector<PlacedSplat> splats = place_splats(cloud, view, rule, progress);
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
    Drawn drawn;
    drawn.film = {view.width, view.height,
                  std::vector<FilmPixel>(std::size_t{view.width} * view.height)};
    const bool is_encoded = model_.blends_encoded(settings);
    std::vector<std::uint64_t> evaluations(tiling.count(), 0);
    tbb::parallel_for(std::size_t{0}, tiling.count(), [&](std::size_t tile) {
      if (progress.cancelled() || lists.list(tile).empty()) return;
      std::vector<VolumePixel> pixels(kTile * kTile);
      evaluations[tile] = composite_tile(composition, lists, tile, pixels);
      const PixelBox box = tiling.box(tile);
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

  VolumeModel model_;
  std::shared_ptr<EnvironmentCache> environments_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  return std::unique_ptr<PreparedModel>(
      std::make_unique<Prepared>(VolumeModel(request.model), request.environments));
}

}  // namespace relief::volume_reference
