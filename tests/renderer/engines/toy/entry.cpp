#include "tests/renderer/engines/toy/entry.h"

#include <cassert>
#include <cmath>
#include <memory>

#include "common/transform.h"
#include "renderer/engine_options.h"
#include "renderer/frame/targets/film.h"
#include "renderer/view/view.h"

namespace relief::toy {
namespace {

const OptionValue kDefaultGrey = 0.5;

class Prepared final : public PreparedModel {
 public:
  explicit Prepared(const PatchModel& patches) : patches_(patches) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& /*progress*/) override {
    const auto found = settings.options.find("grey");
    const auto grey = static_cast<float>(
        std::get<double>(found == settings.options.end() ? kDefaultGrey : found->second));
    const View view = make_view(settings.camera, settings.width, settings.height, 1e-3);
    Film film{view.width, view.height,
              std::vector<FilmPixel>(std::size_t{view.width} * view.height)};
    for (const Patch& patch : patches_.patches) {
      for (std::uint32_t j = 0; j < patch.height; ++j) {
        for (std::uint32_t i = 0; i < patch.width; ++i) {
          if (patch.at(i, j) == kHole) continue;
          const glm::dvec3 seen = view.rotation * (position_of(patch, i, j) - view.eye);
          if (seen.z >= 0.0) continue;
          const double u = seen.x / (-seen.z * view.slope_x);
          const double v = seen.y / (-seen.z * view.slope_y);
          const double x = std::floor(0.5 * (u + 1.0) * view.width);
          const double y = std::floor(0.5 * (1.0 - v) * view.height);
          if (x < 0.0 || y < 0.0 || x >= view.width || y >= view.height) continue;
          const auto pixel = static_cast<std::size_t>(y) * view.width + static_cast<std::size_t>(x);
          film.pixels[pixel].colour = {grey, grey, grey, 1.0F};
        }
      }
    }
    RenderResult result;
    result.renderer = "toy";
    result.image =
        develop(film, {{}, settings.background}, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  const PatchModel& patches_;
};

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && "this engine draws patches");
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(*patches));
}

}  // namespace

EngineEntry entry() {
  return {.name = "toy",
          .summary = "draws each sample as one pixel",
          .forms = {ModelForm::Patches},
          .options = {own_option({.key = "grey",
                                  .range = {0.0, 1.0},
                                  .placeholder = "G",
                                  .help = "linear brightness of a sample",
                                  .default_text = "0.5"},
                                 kDefaultGrey)},
          .prepare = prepare};
}

}  // namespace relief::toy
