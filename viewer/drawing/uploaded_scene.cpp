#include "viewer/drawing/uploaded_scene.h"

#include <algorithm>
#include <utility>

#include "renderer/engine_checks.h"
#include "renderer/frame/features.h"
#include "renderer/gl/software.h"

namespace relief {
namespace {

/// What decides what is uploaded; shaders are compiled when they are first needed.
struct Kind {
  std::string engine;
  StoreNeeds needs;
  bool is_proxy_from_afar = false;
  CullMode cull = CullMode::Safe;

  bool operator==(const Kind&) const = default;
};

Kind kind_of(const RenderSettings& look, const ModelMaps& maps) {
  const EngineEntry* const engine = find_engine(look.engine);
  Kind kind{look.engine, {}, draws_from_afar(look), look.cull};
  if (engine != nullptr && engine->features != nullptr)
    kind.needs = needs_of(engine->features(look, maps));
  return kind;
}

/// What OpenGL on the CPU takes is memory, too, and it is to make the largest texture in less than
/// a tenth of a second.
StreamBudget budget_for(StreamBudget budget, const Gl& gl) {
  const bool is_software = draws_on_cpu(gl);
  if (budget.gpu == 0) budget.gpu = is_software ? kSoftwareBudget.gpu : kHardwareBudget.gpu;
  if (budget.memory == 0)
    budget.memory = is_software ? kSoftwareBudget.memory : kHardwareBudget.memory;
  return budget;
}

}  // namespace

UploadedScene::UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene,
                             StreamOptions options)
    : load_(std::move(load)),
      scene_(std::move(scene)),
      forms_(scene_->forms()),
      options_(std::move(options)) {}

Result<std::unique_ptr<UploadedScene>> UploadedScene::create(
    const GlLoader& load, std::shared_ptr<const LoadedScene> scene, const Looks& looks,
    const StreamOptions& options, CollectedStore* collected) {
  std::unique_ptr<UploadedScene> made(new UploadedScene(load, std::move(scene), options));
  RELIEF_TRY(made->prepare(looks, collected));
  return made;
}

bool UploadedScene::has(const RenderSettings& look) const {
  const ModelMaps maps(scene_->patches);
  const auto kind = kind_of(look, maps);
  return std::any_of(looks_.begin(), looks_.end(),
                     [&](const RenderSettings& known) { return kind_of(known, maps) == kind; });
}

Status UploadedScene::prepare(const Looks& looks, CollectedStore* collected) {
  for (const RenderSettings& look : list_of(looks)) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(look.engine, engines()));
    RELIEF_TRY(check_engine(*engine, look, forms_));
  }
  std::vector<RenderSettings> wanted = looks_;
  if (!has(looks.first)) wanted.push_back(looks.first);
  if (looks.second && !has(*looks.second)) wanted.push_back(*looks.second);
  if (viewport_ != nullptr && wanted.size() == looks_.size()) return {};
  if (scene_->tiles != nullptr) {
    RELIEF_TRY(prepare_stream(wanted));
  } else {
    RELIEF_TRY_ASSIGN(viewport_, Viewport::create(load_, forms_, wanted, engines(), collected));
  }
  looks_ = std::move(wanted);
  return {};
}

/// What is read stays for looks that need no more of it than those before.
Status UploadedScene::prepare_stream(const std::vector<RenderSettings>& looks) {
  if (opengl_ == nullptr) {
    RELIEF_TRY_ASSIGN(opengl_, OpenGl::adopt(load_));
  }
  const StoreNeeds needs = pool_needs(scene_->patches, looks);
  std::unique_ptr<StreamedPatches> made;
  if (stream_ == nullptr || needs != stream_needs_) {
    RELIEF_TRY_ASSIGN(made, StreamedPatches::create(opengl_->gl(), scene_->tiles, needs,
                                                    budget_for(options_.budget, opengl_->gl()),
                                                    looks, options_.wake));
  }
  const StreamedPatches& patches = made ? *made : *stream_;
  RELIEF_TRY_ASSIGN(viewport_, Viewport::create(load_, scene_->patches, patches.pool(), looks));
  if (made) stream_ = std::move(made);
  stream_needs_ = needs;
  return {};
}

}  // namespace relief
