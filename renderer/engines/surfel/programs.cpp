#include "renderer/engines/surfel/programs.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::surfel {
namespace {

constexpr std::uint32_t kClipFeatures =
    RELIEF_FEATURE_CLIPPED | RELIEF_FEATURE_CLIP_WICKE | RELIEF_FEATURE_OUT_CLIP;

}  // namespace

Result<const SurfelPrograms*> Programs::of(const SurfelKind& kind) {
  auto& made = of_kinds_[kind.index()];
  if (!made) {
    Features features = kind.clipped ? features_ : features_.without(kClipFeatures);
    if (kind.curved) features |= RELIEF_FEATURE_CURVED;
    const auto make = [&](std::string_view pass, Features bits) {
      return make_program(
          *gl_,
          fmt::format("{}{}{}", kind.clipped ? "clipped " : "", kind.curved ? "curved " : "", pass),
          fmt::format("surfel/{}.vert", pass), fmt::format("surfel/{}.frag", pass), bits);
    };
    RELIEF_TRY_ASSIGN(Program visibility, make("visibility", features));
    RELIEF_TRY_ASSIGN(Program accumulation,
                      make("accumulation", features.without(RELIEF_FEATURE_OUT_CLIP)));
    made.emplace(SurfelPrograms{std::move(visibility), std::move(accumulation)});
  }
  return &*made;
}

Result<const Program*> Programs::shading() {
  if (!shading_) {
    RELIEF_TRY_ASSIGN(
        Program made,
        make_program(*gl_, "shading", "environment/screen.vert", "surfel/shading.frag",
                     summed_features(features_).without(kClipFeatures | RELIEF_FEATURE_SIDED)));
    shading_ = std::move(made);
  }
  return &*shading_;
}

Features summed_features(Features features) {
  if (!features.has(RELIEF_FEATURE_SORTED)) return features;
  return features.only(RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH |
                       RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH |
                       RELIEF_FEATURE_ORTHOGRAPHIC | RELIEF_FEATURE_COUNT_FRAGMENTS |
                       RELIEF_FEATURE_OUT_CLIP | RELIEF_FEATURE_SIDED) |
         RELIEF_FEATURE_COLOURS;
}

}  // namespace relief::surfel
