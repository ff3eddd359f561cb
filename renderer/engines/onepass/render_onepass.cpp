#include "renderer/engines/onepass/render_onepass.h"

#include <memory>
#include <utility>
#include <vector>

#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/frame/engine_cache.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/gl_image.h"
#include "renderer/shading/materials.h"

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

/// The materials of bodies that light leaves through a second interface.
MaterialChoice materials_of_bodies(const RenderSettings& settings) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  MaterialChoice choice;
  for (std::size_t i = 0; i < kMaxMaterials; ++i)
    choice.drawn.push_back(has_two_interfaces(all[i < all.size() ? i : 0]));
  return choice;
}

/// What a picture is drawn into beside its targets. Null where its features ask for none.
struct Buffers {
  std::shared_ptr<const Visibility> visibility;
  std::shared_ptr<const Back> back;
};

/// What draws the patches of those materials with an engine.
auto draw_with(Buffers buffers, MaterialChoice materials) {
  return [buffers = std::move(buffers), materials = std::move(materials)](const Engine& drawing) {
    return [buffers, materials, &drawing](const GlPicture& frame, PassTimer& timer) {
      drawing.draw(frame, buffers.visibility.get(), buffers.back.get(), materials, timer);
    };
  };
}

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  Result<GlDrawing> make_drawing(const RenderSettings& settings, const Raster& part) override {
    std::uint32_t features = features_of(settings, model().maps());
    if (!can_be_found(model().store())) {
      if (has_two_interfaces(settings))
        return make_error("a scene of more than a million patches can't have two interfaces");
      features &= ~RELIEF_FEATURE_VISIBILITY;
    }
    RELIEF_TRY_ASSIGN(auto picture, model().make_picture(settings, part));
    if (is_transparent(settings)) return make_layered(settings, features, std::move(picture));
    RELIEF_TRY_ASSIGN(auto buffers, buffers_of(settings, picture, features));
    return engines_.make_drawing(model(), features, std::move(picture), !settings.explain,
                                 draw_with(std::move(buffers), {}));
  }

 private:
  [[nodiscard]] Result<Buffers> buffers_of(const RenderSettings& settings, const GlPicture& picture,
                                           std::uint32_t features) const {
    Buffers buffers;
    if ((features & RELIEF_FEATURE_VISIBILITY) == 0) return buffers;
    const Targets& targets = picture.targets;
    auto visibility =
        make_visibility(model().gl(), {targets.width, targets.height}, targets.z_buffer, features);
    if (!visibility) return visibility.error();
    buffers.visibility = std::make_shared<const Visibility>(std::move(*visibility));
    if ((features & RELIEF_FEATURE_TWO_INTERFACES) == 0) return buffers;
    RELIEF_TRY_ASSIGN(auto back, make_back(model().gl(), model().view_of(settings),
                                           materials_of_bodies(settings), features));
    buffers.back = std::make_shared<const Back>(std::move(back));
    return buffers;
  }

  /// A picture with semi-transparent materials: the opaque ones first. Its fragments are not
  /// counted.
  Result<GlDrawing> make_layered(const RenderSettings& settings, std::uint32_t features,
                                 GlPicture picture) {
    if ((features & RELIEF_FEATURE_VISIBILITY) == 0)
      return make_error("a scene of more than a million patches can't be semi-transparent");
    RELIEF_TRY_ASSIGN(auto made, make_layers(model().gl(), picture.targets, features));
    const auto layers = std::make_shared<const Layers>(std::move(made));
    RELIEF_TRY_ASSIGN(const auto layered, engines_.get(model(), features | RELIEF_FEATURE_LAYERED));
    RELIEF_TRY_ASSIGN(auto buffers, buffers_of(settings, picture, features));
    auto drawing =
        engines_.make_drawing(model(), features, std::move(picture), false,
                              draw_with(std::move(buffers), materials_that_are(settings, true)));
    if (!drawing) return drawing;
    drawing->draw_over = [layers, materials = materials_that_are(settings, false),
                          &engine = *layered](const GlPicture& frame, PassTimer& timer) {
      engine.draw_over(frame, *layers, materials, timer);
    };
    return drawing;
  }

  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  return prepare_on_gpu<Prepared>(request, features_of);
}

}  // namespace relief::onepass
