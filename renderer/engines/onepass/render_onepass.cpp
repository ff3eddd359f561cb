#include "renderer/engines/onepass/render_onepass.h"

#include <memory>
#include <utility>
#include <vector>

#include "renderer/engine_cache.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/gl_picture.h"
#include "renderer/materials.h"

namespace relief::onepass {
namespace {

/// The patches whose materials are opaque, or those whose are not.
MaterialChoice materials_that_are(const RenderSettings& settings, bool opaque) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  MaterialChoice choice;
  for (std::size_t i = 0; i < kMaxMaterials; ++i) {
    const MaterialSettings& material = all[i < all.size() ? i : 0];  // one: that of all patches
    choice.drawn.push_back(is_transparent(material) != opaque);
  }
  return choice;
}

using SharedVisibility = std::shared_ptr<const Visibility>;

/// What draws the patches of those materials with an engine.
auto draw_with(SharedVisibility visibility, MaterialChoice materials) {
  return [visibility = std::move(visibility),
          materials = std::move(materials)](const Engine& drawing) {
    return [visibility, materials, &drawing](const GlPicture& frame, PassTimer& timer) {
      drawing.draw(frame, visibility.get(), materials, timer);
    };
  };
}

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  Result<GlDrawing> make_drawing(const RenderSettings& settings, const Raster& part) override {
    std::uint32_t features = features_of(settings, model().maps());
    if (!can_be_found(model().store())) features &= ~RELIEF_FEATURE_VISIBILITY;
    auto picture = model().make_picture(settings, part);
    if (!picture) return picture.error();
    if (is_transparent(settings)) return make_layered(settings, features, std::move(*picture));
    const auto visibility = visibility_of(*picture, features);
    if (!visibility) return visibility.error();
    return engines_.make_drawing(model(), features, std::move(*picture), !settings.explain,
                                 draw_with(*visibility, {}));
  }

 private:
  /// Null where the features ask for none.
  [[nodiscard]] Result<SharedVisibility> visibility_of(const GlPicture& picture,
                                                       std::uint32_t features) const {
    if ((features & RELIEF_FEATURE_VISIBILITY) == 0) return SharedVisibility();
    const Targets& targets = picture.targets;
    auto made = make_visibility(model().gl(), targets, targets.z_buffer, features);
    if (!made) return made.error();
    return std::make_shared<const Visibility>(std::move(*made));
  }

  /// A picture with semi-transparent materials: the opaque ones first. Its fragments are not
  /// counted.
  Result<GlDrawing> make_layered(const RenderSettings& settings, std::uint32_t features,
                                 GlPicture picture) {
    if ((features & RELIEF_FEATURE_VISIBILITY) == 0)
      return make_error("a scene of more than a million patches can't be semi-transparent");
    auto made = make_layers(model().gl(), picture.targets, features);
    if (!made) return made.error();
    const auto layers = std::make_shared<const Layers>(std::move(*made));
    const auto layered = engines_.get(model(), features | RELIEF_FEATURE_LAYERED);
    if (!layered) return layered.error();
    const auto visibility = visibility_of(picture, features);
    if (!visibility) return visibility.error();
    auto drawing =
        engines_.make_drawing(model(), features, std::move(picture), false,
                              draw_with(*visibility, materials_that_are(settings, true)));
    if (!drawing) return drawing;
    drawing->draw_over = [layers, materials = materials_that_are(settings, false),
                          &engine = **layered](const GlPicture& frame, PassTimer& timer) {
      engine.draw_over(frame, *layers, materials, timer);
    };
    return drawing;
  }

  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<GlPreparedModel>> prepare(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views) {
  return prepare_on_gpu<Prepared>(std::move(opengl), model, views, features_of);
}

}  // namespace relief::onepass
