// What an engine is: its entry in the registry, and what it makes of a model.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"
#include "common/progress.h"
#include "common/scene/choices.h"
#include "common/scene/option.h"
#include "renderer/gl/shader/features.h"
#include "renderer/model.h"
#include "renderer/result.h"
#include "renderer/settings.h"

namespace relief {

class CollectedStore;
class EnvironmentCache;
class OpenGl;
class PatchPool;
struct ModelMaps;

/// A model that an engine has made ready for any number of images. What does not depend on the view
/// is made when this is made (the model on the GPU, a tree over triangles, a cloud of splats), or
/// by the first image that needs it. The model outlives it. Used only from the thread that made it.
class PreparedModel {
 public:
  PreparedModel() = default;
  virtual ~PreparedModel() = default;
  PreparedModel(const PreparedModel&) = delete;
  PreparedModel& operator=(const PreparedModel&) = delete;

  /// Renders one image, which does not depend on those rendered before. `settings` are among the
  /// views that the model was prepared for.
  virtual Result<RenderResult> render(const RenderSettings& settings, Progress& progress) = 0;

  /// What one pixel of such an image shows, from one sample: an image of that pixel with colour,
  /// depth and patch. `x` and `y`: from the lower left corner. An engine that cannot draw it alone
  /// says that nothing is seen.
  virtual Result<Image> probe(const RenderSettings& settings, std::uint32_t x, std::uint32_t y);
};

/// A pixel as PreparedModel::probe() has it where nothing is seen.
[[nodiscard]] Image nothing_seen();

/// Which levels of detail of a model's patches are kept on the GPU: those that the views choose, or
/// all, for views that are not known yet.
enum class KeptLevels : std::uint8_t { OfViews, All };

/// What an engine prepares a model from.
struct PrepareRequest {
  const RenderModel& model;               ///< has one of the engine's forms
  std::span<const RenderSettings> views;  ///< all of this engine; not empty
  std::shared_ptr<const OpenGl> opengl;   ///< current; null for an engine that does not need it
  std::shared_ptr<EnvironmentCache> environments;  ///< decoded once, whatever engine asks first
  KeptLevels levels = KeptLevels::OfViews;
  /// The patches on the GPU, if they come and go: `model` then has none, and says what is known of
  /// all. Outlives what is prepared.
  const PatchPool* pool = nullptr;
  /// Of the model for these views, collected before on another thread; used up. Null: is done now.
  CollectedStore* collected = nullptr;
};

/// Whether an engine can do something: never, always, or with some primitives only.
class Support {
 public:
  constexpr Support() = default;  ///< never
  [[nodiscard]] static constexpr Support always() { return Support(0xFFU); }
  [[nodiscard]] static constexpr Support with(Primitive primitive) {
    return Support(1U << static_cast<unsigned>(primitive));
  }
  [[nodiscard]] constexpr bool has(Primitive primitive) const {
    return (primitives_ & 1U << static_cast<unsigned>(primitive)) != 0;
  }
  [[nodiscard]] constexpr bool any() const { return primitives_ != 0; }
  /// Whether it takes a certain primitive.
  [[nodiscard]] constexpr bool depends() const { return any() && primitives_ != 0xFFU; }

 private:
  explicit constexpr Support(unsigned primitives) : primitives_(primitives) {}
  unsigned primitives_ = 0;
};

/// What an engine can do beside opaque images of its model.
struct EngineCapabilities {
  bool needs_opengl = false;
  Support transparency = {};    ///< materials with an opacity below 1
  Support two_interfaces = {};  ///< glass that refracts where light leaves it, too
  /// Material::Split, which shows the samples that a position lies between: of patches only.
  Support split_view = {};
  bool cull_modes = false;
  bool samples_per_pixel = false;
  bool levels_of_detail = false;
  bool explanation = false;      ///< RenderSettings::explain
  bool clips_splats = false;     ///< RenderSettings::clip, Outputs::clip
  bool textures_splats = false;  ///< SplatCloud::texture
};

/// An option of an engine: what it accepts, and where its value goes.
struct EngineOption {
  OptionRow row;
  std::function<void(RenderSettings&, const OptionValue&)> set;
  /// The value that is in force; none if the option is off.
  std::function<std::optional<OptionValue>(const RenderSettings&)> get;
};

/// An engine: a way to turn a model into pixels. Its folder defines it; engine_registry.cpp lists
/// it.
struct EngineEntry {
  std::string name = {};
  std::string summary = {};           ///< one line for `--help`
  std::vector<ModelForm> forms = {};  ///< that it draws, the preferred one first
  std::string surfaces_by =
      {};  ///< the engine that draws surfaces among what it draws; empty: none
  std::vector<Primitive> primitives = {};  ///< the first is the default; empty: none to choose
  std::vector<Interpolation> interpolations = {};  ///< likewise
  EngineCapabilities capabilities = {};
  std::vector<EngineOption> options = {};
  /// The variants that `relief bench` times, as values of some of the options. Only of engines that
  /// need OpenGL.
  std::vector<OptionValues> bench_variants = {};
  /// The variants that stand for the engine where `relief bench --engines` compares engines, each
  /// also clipped if the engine clips splats; empty: its defaults.
  std::vector<OptionValues> compared_variants = {};
  /// The feature bits of an image, from which follows what is uploaded of a model with these maps.
  /// Only of engines that need OpenGL.
  Features (*features)(const RenderSettings& settings, ModelMaps maps) = nullptr;
  /// Makes a model ready. An engine that needs OpenGL gives a GlPreparedModel
  /// (renderer/frame/gl_engine.h).
  Result<std::unique_ptr<PreparedModel>> (*prepare)(const PrepareRequest& request) = nullptr;
};

}  // namespace relief
