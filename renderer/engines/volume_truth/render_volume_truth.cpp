#include "renderer/engines/volume_truth/render_volume_truth.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

#include "common/median.h"
#include "renderer/engines/volume_truth/field_truth.h"
#include "renderer/engines/volume_truth/gaussian_truth.h"
#include "renderer/engines/volume_truth/kernel_truth.h"
#include "renderer/engines/volume_truth/truth_settings.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume_truth {
namespace {

using TruthClock = std::chrono::steady_clock;

/// Rays that are kept at once: 6 GB of them.
constexpr std::uint64_t kMostRays = 1U << 27U;

/// Those of the pixels; the filter's border comes on top.
std::uint64_t rays_of(const View& view, const TruthSettings& truth) {
  return std::uint64_t{view.width} * view.height * static_cast<std::uint64_t>(truth.side) *
         static_cast<std::uint64_t>(truth.side);
}

class PreparedTruth final : public PreparedModel {
 public:
  PreparedTruth(VolumeModel model, std::shared_ptr<EnvironmentCache> environments)
      : model_(std::move(model)), environments_(std::move(environments)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    const TruthSettings truth = truth_settings(settings);
    if (rays_of(view, truth) > kMostRays) {
      return make_error(
          "an image of {}x{} with {} samples a pixel needs more than {} rays; "
          "choose fewer samples or a smaller image",
          view.width, view.height, truth.side * truth.side, kMostRays);
    }
    Film film;
    std::vector<double> frame_ms;
    for (int i = 0; i < std::max(settings.frames, 1); ++i) {
      const auto start = TruthClock::now();
      SampleImage image(view, truth.side);
      RELIEF_TRY(integrate(settings, truth, view, image, progress));
      if (progress.cancelled()) return interrupted_error();
      film = filtered(image, view, model_.blends_encoded(settings));
      frame_ms.push_back(
          std::chrono::duration<double, std::milli>(TruthClock::now() - start).count());
    }
    RenderResult result;
    result.renderer = "CPU";
    result.frame_ms = median_of(std::move(frame_ms));
    result.image = develop(film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  Status integrate(const RenderSettings& settings, const TruthSettings& truth, const View& view,
                   SampleImage& into, Progress& progress) {
    if (model_.volume() != nullptr && truth.truth == Truth::Field)
      return integrate_values(settings, truth, view, into, progress);
    if (model_.volume() != nullptr && settings.volume.iso) {
      return make_error(
          "--truth kernels can't integrate the flattened kernels of --iso; use --truth field");
    }
    const RegularGrid* grid = nullptr;
    if (model_.volume() != nullptr) {
      RELIEF_TRY_ASSIGN(grid, regular_grid());
    }
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto colours, model_.colours(*cloud, settings, view, *environments_));
    if (grid == nullptr) {
      meet_gaussians(*cloud, colours, view, settings.volume.gaussians, truth.order, into, progress);
      return {};
    }
    const NodeKernels kernels(*cloud, colours, *grid, settings.volume.kernel_sigma);
    integrate_kernels(kernels, *grid, view, truth.step, into, progress);
    return {};
  }

  Status integrate_values(const RenderSettings& settings, const TruthSettings& truth,
                          const View& view, SampleImage& into, Progress& progress) {
    RELIEF_TRY_ASSIGN(const RegularGrid* const grid, regular_grid());
    RELIEF_TRY_ASSIGN(const TransferFunction function,
                      transfer_function_for(settings.volume.transfer, *model_.volume()));
    RELIEF_TRY_ASSIGN(const auto clip, model_.clip_box(settings));
    std::optional<Lighting> lighting;
    if (settings.material != Material::Unlit) {
      RELIEF_TRY_ASSIGN(lighting, make_lighting(settings, view, *environments_));
    }
    if (!field_) {
      field_.emplace(*model_.volume(), progress);
      if (progress.cancelled()) {
        field_.reset();
        return interrupted_error();
      }
    }
    integrate_field({.field = *field_,
                     .grid = *grid,
                     .function = function,
                     .lighting = lighting ? &*lighting : nullptr,
                     .iso = settings.volume.iso,
                     .iso_opacity = std::min(settings.volume.iso_opacity, kMaxOpacity),
                     .clip = clip},
                    view, truth.step, into, progress);
    return {};
  }

  [[nodiscard]] Result<const RegularGrid*> regular_grid() const {
    const auto* const grid = std::get_if<RegularGrid>(&model_.volume()->placement);
    if (grid == nullptr) {
      return make_error(
          "engine volume-truth draws volumes with a regular grid only, and this one has another; "
          "use engine volume-reference");
    }
    return grid;
  }

  VolumeModel model_;
  std::shared_ptr<EnvironmentCache> environments_;
  std::optional<ValueField> field_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  return std::unique_ptr<PreparedModel>(
      std::make_unique<PreparedTruth>(VolumeModel(request.model), request.environments));
}

}  // namespace relief::volume_truth
