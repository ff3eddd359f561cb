#include "renderer/engines/surfel/programs.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "renderer/gl/program.h"
#include "shaders/surfel/layout.h"

namespace relief::surfel {

Result<const SurfelPrograms*> Programs::of(SurfelKind kind) {
  auto& made = of_kinds_[static_cast<std::size_t>(kind)];
  if (!made) {
    const bool curved = kind == SurfelKind::Curved;
    const Features features = curved ? features_ | RELIEF_FEATURE_CURVED : features_;
    const auto make = [&](std::string_view pass) {
      return make_program(*gl_, fmt::format("{}{}", curved ? "curved " : "", pass),
                          fmt::format("surfel/{}.vert", pass), fmt::format("surfel/{}.frag", pass),
                          features);
    };
    RELIEF_TRY_ASSIGN(Program visibility, make("visibility"));
    RELIEF_TRY_ASSIGN(Program accumulation, make("accumulation"));
    made.emplace(SurfelPrograms{std::move(visibility), std::move(accumulation)});
  }
  return &*made;
}

Result<const Program*> Programs::shading() {
  if (!shading_) {
    RELIEF_TRY_ASSIGN(Program made,
                      make_program(*gl_, "shading", "environment/screen.vert",
                                   "surfel/shading.frag", summed_features(features_)));
    shading_ = std::move(made);
  }
  return &*shading_;
}

Features summed_features(Features features) {
  if (!features.has(RELIEF_FEATURE_SORTED)) return features;
  return features.only(RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH |
                       RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH |
                       RELIEF_FEATURE_ORTHOGRAPHIC | RELIEF_FEATURE_COUNT_FRAGMENTS) |
         RELIEF_FEATURE_COLOURS;
}

}  // namespace relief::surfel
