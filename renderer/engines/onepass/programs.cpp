#include "renderer/engines/onepass/programs.h"

#include <algorithm>
#include <utility>

#include "renderer/engines/onepass/visibility.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

/// Of the features of an image that is shaded later, those of the pass that finds the surface.
constexpr std::uint32_t kFindingFeatures =
    RELIEF_FEATURE_VISIBILITY | RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED |
    RELIEF_FEATURE_CORRECTED | RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS |
    RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_COUNT_FRAGMENTS | RELIEF_FEATURE_ORTHOGRAPHIC |
    RELIEF_FEATURE_TWO_INTERFACES;

/// What the layers behind the first have nothing to say about.
constexpr std::uint32_t kOutputFeatures = RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH |
                                          RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH;

/// Nodes along the longest side of any patch or level.
std::uint32_t widest_side(const PatchStore& store) {
  std::uint32_t widest = 1;
  for (const StoredPatch& patch : store.patches) widest = std::max(widest, patch.side);
  return widest;
}

/// What models seen from afar have nothing to do with.
constexpr std::uint32_t kNearFeatures = RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED |
                                        RELIEF_FEATURE_CORRECTED | RELIEF_FEATURE_VISIBILITY |
                                        RELIEF_FEATURE_FINE_COLOURS | RELIEF_FEATURE_FINE_NORMALS |
                                        RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_TWO_INTERFACES;

Result<Programs> make_cell_programs(const Gl& gl, const PatchStore& store, Features features) {
  // What finds the surface needs nothing of what shades it.
  const bool shaded_later = features.has(RELIEF_FEATURE_VISIBILITY);
  const Features found = shaded_later ? features.only(kFindingFeatures) : features;
  // A cell is the surface: there is nothing to correct.
  const Features whole = found.without(RELIEF_FEATURE_MASKED);
  const auto make_cells = [&](const char* name, const char* stage) {
    return make_program(gl, name, stage, "onepass/quad.frag",
                        whole.without(RELIEF_FEATURE_CORRECTED));
  };
  const std::vector<StoredPart>& parts = store.cells->parts;
  const bool any_strips = std::any_of(
      parts.begin(), parts.end(), [](const StoredPart& part) { return part.buffers.strip > 0; });
  RELIEF_TRY_ASSIGN(Program cells, any_strips ? make_cells("cell strips", "onepass/strip.vert")
                                              : make_cells("cells", "onepass/cell.vert"));
  RELIEF_TRY_ASSIGN(Program rims,
                    make_program(gl, "rims", "onepass/quad.vert", "onepass/quad.frag", whole));
  Programs programs{std::move(cells), std::nullopt, std::move(rims)};
  if (any_strips && std::any_of(parts.begin(), parts.end(),
                                [](const StoredPart& part) { return part.buffers.runs > 0; })) {
    RELIEF_TRY_ASSIGN(Program runs, make_cells("cells", "onepass/cell.vert"));
    programs.runs = std::move(runs);
  }
  if (std::any_of(parts.begin(), parts.end(),
                  [](const StoredPart& part) { return part.buffers.borders > 0; })) {
    RELIEF_TRY_ASSIGN(Program borders, make_cells("border cells", "onepass/border.vert"));
    programs.borders = std::move(borders);
  }
  if (found != whole && store.masks) {
    RELIEF_TRY_ASSIGN(Program edges,
                      make_program(gl, "edges", "onepass/cell.vert", "onepass/quad.frag",
                                   found.without(RELIEF_FEATURE_CORRECTED)));
    programs.edges = std::move(edges);
  }
  if (store.seams) {
    RELIEF_TRY_ASSIGN(Program seams,
                      make_program(gl, "seams", "onepass/seam.vert", "onepass/quad.frag",
                                   whole.without(RELIEF_FEATURE_CORRECTED)));
    programs.seams = std::move(seams);
  }
  if (store.proxies) {
    RELIEF_TRY_ASSIGN(Program proxy,
                      make_program(gl, "proxies", "onepass/proxy.vert", "onepass/proxy.frag",
                                   features.without(kNearFeatures)));
    programs.proxy = std::move(proxy);
  }
  if (!shaded_later) return programs;
  RELIEF_TRY_ASSIGN(Program shading,
                    make_program(gl, "shading", "environment/screen.vert", "onepass/shading.frag",
                                 features.without(RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED |
                                                  RELIEF_FEATURE_CORRECTED)));
  programs.shading = std::move(shading);
  if (features.has(RELIEF_FEATURE_LAYERED)) {
    RELIEF_TRY_ASSIGN(
        Program behind,
        make_program(gl, "shading behind", "environment/screen.vert", "onepass/shading.frag",
                     features.without(kOutputFeatures | RELIEF_FEATURE_CELL |
                                      RELIEF_FEATURE_MASKED | RELIEF_FEATURE_CORRECTED)));
    programs.behind = std::move(behind);
    RELIEF_TRY_ASSIGN(Program over,
                      make_program(gl, "over", "environment/screen.vert", "onepass/over.frag", {}));
    programs.over = std::move(over);
  }
  const float steps = position_steps(widest_side(store));
  const auto tell = [&](const std::optional<Program>& program) {
    if (program) gl.ProgramUniform1f(program->id(), RELIEF_UNIFORM_POSITION_STEPS, steps);
  };
  gl.ProgramUniform1f(programs.main.id(), RELIEF_UNIFORM_POSITION_STEPS, steps);
  tell(programs.runs);
  tell(programs.borders);
  tell(programs.rims);
  tell(programs.edges);
  tell(programs.seams);
  tell(programs.shading);
  tell(programs.behind);
  return programs;
}

Result<Programs> make_splat_programs(const Gl& gl, Features features) {
  if (!features.has(RELIEF_FEATURE_SPRITE)) {
    RELIEF_TRY_ASSIGN(Program quads, make_program(gl, "quads", "onepass/quad.vert",
                                                  "onepass/quad.frag", features));
    return Programs{std::move(quads)};
  }
  RELIEF_TRY_ASSIGN(Program sprites, make_program(gl, "sprites", "onepass/sprite.vert",
                                                  "onepass/sprite.frag", features));
  RELIEF_TRY_ASSIGN(
      Program large,
      make_program(gl, "large sprites", "onepass/large_sprite.vert", "onepass/quad.frag",
                   (features.without(RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_FRONT)) |
                       RELIEF_FEATURE_LARGE_SPRITES));
  return Programs{std::move(sprites), std::move(large)};
}

}  // namespace

Result<Programs> make_programs(const Gl& gl, const PatchStore& store, Features features) {
  return features.has(RELIEF_FEATURE_CELL) ? make_cell_programs(gl, store, features)
                                           : make_splat_programs(gl, features);
}

}  // namespace relief::onepass
