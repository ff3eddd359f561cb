#include "renderer/engines/multipass/variant.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::multipass {
namespace {

constexpr std::uint32_t kClipFeatures =
    RELIEF_FEATURE_CLIPPED | RELIEF_FEATURE_CLIP_WICKE | RELIEF_FEATURE_OUT_CLIP;

Result<SplatPrograms> make_splat_programs(const Gl& gl, std::string_view pass, Features features) {
  const std::string_view clipped = features.has(RELIEF_FEATURE_CLIPPED) ? "clipped " : "";
  const auto make = [&](std::string_view shape, std::string_view label, Features bits) {
    const std::string path = fmt::format("multipass/{}_{}", pass, shape);
    return make_program(gl, fmt::format("{}{}{}", clipped, label, pass), path + ".vert",
                        path + ".frag", bits);
  };
  if (!features.has(RELIEF_FEATURE_SPRITE)) {
    RELIEF_TRY_ASSIGN(Program all, make("triangle", "", features));
    return SplatPrograms{std::move(all), std::nullopt};
  }
  RELIEF_TRY_ASSIGN(Program all, make("sprite", "", features));
  RELIEF_TRY_ASSIGN(Program large,
                    make("triangle", "large ",
                         (features.without(RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_FRONT)) |
                             RELIEF_FEATURE_LARGE_SPRITES));
  return SplatPrograms{std::move(all), std::move(large)};
}

}  // namespace

Result<Variant> Variant::create(const Gl& gl, const PatchStore& store, Features all) {
  const Features features = all.without(kClipFeatures);
  RELIEF_TRY_ASSIGN(SplatPrograms visibility, make_splat_programs(gl, "visibility", features));
  RELIEF_TRY_ASSIGN(SplatPrograms accumulation, make_splat_programs(gl, "accumulation", features));
  std::optional<ClippedPrograms> clipped;
  if (all.has(RELIEF_FEATURE_CLIPPED)) {
    RELIEF_TRY_ASSIGN(SplatPrograms first, make_splat_programs(gl, "visibility", all));
    RELIEF_TRY_ASSIGN(
        SplatPrograms second,
        make_splat_programs(gl, "accumulation", all.without(RELIEF_FEATURE_OUT_CLIP)));
    clipped =
        ClippedPrograms{std::move(first), std::move(second), all.has(RELIEF_FEATURE_OUT_CLIP)};
  }
  RELIEF_TRY_ASSIGN(Program shading,
                    make_program(gl, "shading", "environment/screen.vert", "multipass/shading.frag",
                                 features.without(RELIEF_FEATURE_FRONT | RELIEF_FEATURE_SIDED)));
  return Variant{.gl = &gl,
                 .samples = SampleDraws(gl, store),
                 .visibility = std::move(visibility),
                 .accumulation = std::move(accumulation),
                 .clipped = std::move(clipped),
                 .shading = std::move(shading),
                 .nothing = VertexArray(gl, "no attributes")};
}

}  // namespace relief::multipass
