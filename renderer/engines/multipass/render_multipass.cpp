#include "renderer/engines/multipass/render_multipass.h"

#include <utility>
#include <vector>

#include "renderer/engines/multipass/multipass.h"
#include "renderer/engines/multipass/sums.h"
#include "renderer/frame/engine_cache.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/gl_image.h"
#include "renderer/shading/materials.h"

namespace relief::multipass {
namespace {

/// Settings as this engine reads them. It splats samples, always the finest; and of several
/// materials each pixel has that of the patch in front, so that the patch must be known.
RenderSettings splatted(RenderSettings settings) {
  if (settings.primitive == Primitive::Cell) settings.primitive = Primitive::Quad;
  settings.pixels_per_sample = 0.0;
  settings.outputs.patch_id |= materials_of(settings).size() > 1;
  return settings;
}

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  Result<GlDrawing> make_drawing(const RenderSettings& asked, const Raster& part) override {
    const RenderSettings settings = splatted(asked);
    const std::uint32_t features = scene_features(settings, model().maps());
    RELIEF_TRY_ASSIGN(auto picture, model().make_picture(settings, part));
    RELIEF_TRY_ASSIGN(auto made, make_sums(model().gl(), picture.targets, features));
    const auto sums = std::make_shared<const Sums>(std::move(made));
    const double factor = settings.multipass.radius_factor;
    const auto draw_with = [&sums, factor](const Engine& drawing) {
      return [sums, factor, &drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame, *sums, factor, timer);
      };
    };
    return engines_.make_drawing(model(), features, std::move(picture), !settings.explain,
                                 draw_with);
  }

  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    auto result = GlPreparedModel::render(asked, progress);
    if (result && !asked.outputs.patch_id) {
      std::erase_if(result->image.channels,
                    [](const Channel& channel) { return channel.name == "patch"; });
    }
    return result;
  }

 private:
  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  std::vector<RenderSettings> views;
  views.reserve(request.views.size());
  for (const RenderSettings& settings : request.views) views.push_back(splatted(settings));
  return prepare_on_gpu<Prepared>({request.model, views, request.opengl}, scene_features);
}

}  // namespace relief::multipass
