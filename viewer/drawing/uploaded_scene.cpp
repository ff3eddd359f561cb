#include "viewer/drawing/uploaded_scene.h"

#include <algorithm>
#include <iterator>
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

Status UploadedScene::check(const Looks& looks) const {
  for (const RenderSettings& look : list_of(looks)) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(look.engine, engines()));
    RELIEF_TRY(check_engine(*engine, look, forms_));
  }
  return {};
}

bool UploadedScene::are_alike(std::span<const RenderSettings> a,
                              std::span<const RenderSettings> b) const {
  const ModelMaps maps(scene_->patches);
  return std::ranges::equal(a, b, [&](const RenderSettings& one, const RenderSettings& other) {
    return kind_of(one, maps) == kind_of(other, maps);
  });
}

std::vector<std::vector<RenderSettings>> UploadedScene::to_prepare(const Looks& looks) const {
  const ModelMaps maps(scene_->patches);
  const auto has = [&](const std::vector<RenderSettings>& known, const RenderSettings& look) {
    return std::ranges::any_of(known, [kind = kind_of(look, maps), &maps](const auto& other) {
      return kind_of(other, maps) == kind;
    });
  };
  std::vector<std::vector<RenderSettings>> made;
  for (const RenderSettings& look : list_of(looks)) {
    if (has(looks_, look)) continue;
    auto group = std::ranges::find(made, look.engine,
                                   [](const auto& of_engine) { return of_engine.front().engine; });
    if (group == made.end()) {
      group = made.emplace(group);
      std::ranges::copy_if(looks_, std::back_inserter(*group), [&](const RenderSettings& known) {
        return known.engine == look.engine;
      });
    }
    if (!has(*group, look)) group->push_back(look);
  }
  return made;
}

Status UploadedScene::prepare(const Looks& looks, CollectedStore* collected) {
  RELIEF_TRY(check(looks));
  const std::vector<std::vector<RenderSettings>> groups = to_prepare(looks);
  if (groups.empty()) return {};
  std::vector<RenderSettings> wanted = looks_;
  for (const auto& group : groups) {
    std::erase_if(wanted, [&](const auto& look) { return look.engine == group.front().engine; });
    wanted.insert(wanted.end(), group.begin(), group.end());
  }
  if (scene_->tiles != nullptr) {
    RELIEF_TRY(prepare_stream(wanted));
  } else if (viewport_ == nullptr) {
    RELIEF_TRY_ASSIGN(viewport_, Viewport::create(load_, forms_, wanted, engines(), collected));
  } else {
    for (const auto& group : groups)
      RELIEF_TRY(viewport_->prepare(group, groups.size() == 1 ? collected : nullptr));
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
