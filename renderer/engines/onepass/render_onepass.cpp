#include "renderer/engines/onepass/render_onepass.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/frame.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/environment.h"
#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/functions.h"
#include "renderer/patch_store.h"

namespace relief::onepass {
namespace {

/// A near plane that no surface that can be told apart from the eye is in front of.
double near_of(const PatchModel& model) {
  double spacing = model.spacing > 0.0 ? model.spacing : 1.0;
  for (const Patch& patch : model.patches) spacing = std::min(spacing, patch.spacing);
  return 0.01 * spacing;
}

/// A context with its functions, at an address that lasts: everything made with them keeps it.
struct Device {
  std::unique_ptr<GlContext> context;
  Gl gl;
  std::optional<DebugLog> log;
};

Result<std::unique_ptr<Device>> make_device(GlPlatform platform, bool debug) {
  auto device = std::make_unique<Device>();
  auto context = make_context(platform, debug);
  if (!context) return context.error();
  device->context = std::move(*context);
  const auto functions = load_functions(*device->context);
  if (!functions) return functions.error();
  device->gl = *functions;
  if (debug) device->log.emplace(device->gl);
  return device;
}

/// The model on the GPU, and what pictures have needed so far.
class Prepared final : public PreparedModel {
 public:
  Prepared(std::unique_ptr<Device> device, PatchStore store, bool has_colours, double near)
      : device_(std::move(device)),
        store_(std::move(store)),
        has_colours_(has_colours),
        near_(near) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& /*progress*/) override {
    const std::uint32_t features = features_of(settings, has_colours_);
    const auto engine = engine_for(features);
    if (!engine) return engine.error();
    const auto counting = engine_for(features | RELIEF_FEATURE_COUNT_FRAGMENTS);
    if (!counting) return counting.error();
    FrameParts parts{**engine, **counting, nullptr, nullptr};
    const bool shown = !settings.environment.empty() && settings.background.has_value();
    if (shown || settings.material == Material::Mirror) {
      const auto environment = environment_for(settings.environment);
      if (!environment) return environment.error();
      parts.environment = *environment;
    }
    if (shown) {
      const auto backdrop = backdrop_for();
      if (!backdrop) return backdrop.error();
      parts.backdrop = *backdrop;
    }
    auto result = draw_picture(device_->gl, parts, settings, near_);
    if (result && device_->log && !device_->log->status()) return device_->log->status().error();
    return result;
  }

 private:
  Result<const Engine*> engine_for(std::uint32_t features) {
    auto found = engines_.find(features);
    if (found == engines_.end()) {
      Result<Engine> made = Engine::create(device_->gl, store_, features);
      if (!made) return made.error();
      found = engines_.emplace(features, std::move(*made)).first;
    }
    return &found->second;
  }

  Result<const Texture*> environment_for(const std::filesystem::path& path) {
    auto found = environments_.find(path);
    if (found == environments_.end()) {
      const Result<CubeMap> cube = load_environment(path);
      if (!cube) return cube.error();
      Result<Texture> made = upload_environment(device_->gl, *cube);
      if (!made) return made.error();
      found = environments_.emplace(path, std::move(*made)).first;
    }
    return &found->second;
  }

  Result<const Backdrop*> backdrop_for() {
    if (!backdrop_) {
      Result<Backdrop> made = Backdrop::create(device_->gl);
      if (!made) return made.error();
      backdrop_ = std::move(*made);
    }
    return &*backdrop_;
  }

  std::unique_ptr<Device> device_;  ///< first: the last to go
  PatchStore store_;
  bool has_colours_;
  double near_;
  std::map<std::uint32_t, Engine> engines_;  ///< by feature bits
  std::map<std::filesystem::path, Texture> environments_;
  std::optional<Backdrop> backdrop_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PatchModel& model,
                                               std::span<const RenderSettings> views) {
  assert(!views.empty() && "a model is prepared for at least one view");
  StoreNeeds needs;
  for (const RenderSettings& settings : views) {
    assert(settings.platform == views.front().platform && settings.debug == views.front().debug);
    const StoreNeeds more = needs_of(features_of(settings, model.has_colours));
    needs.splats = needs.splats || more.splats;
    needs.heights = needs.heights || more.heights;
    needs.cells = needs.cells || more.cells;
    needs.normals = needs.normals || more.normals;
    needs.colours = needs.colours || more.colours;
  }
  auto device = make_device(views.front().platform, views.front().debug);
  if (!device) return device.error();
  auto store = upload_model((*device)->gl, model, needs);
  if (!store) return store.error();
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(
      std::move(*device), std::move(*store), model.has_colours, near_of(model)));
}

}  // namespace relief::onepass
