#include "loader/scene/patch_sections.h"

#include <algorithm>
#include <set>

#include "common/patch_file/patch_tree.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "renderer/frame/features.h"

namespace relief {
namespace {

/// What the files of a plan hold, by their indices.
struct Contents {
  ShownColours colours;
  bool have_seams = false;  ///< patches of one of them meet
};

Result<Contents> contents_of(const ScenePlan& plan) {
  Contents contents;
  ShownColours& colours = contents.colours;
  std::set<std::filesystem::path> seen;
  for (const SceneModel& model : plan.models) {
    if (!seen.insert(model.file).second) continue;
    RELIEF_TRY_ASSIGN(const PatchTree tree, PatchTree::open(model.file));
    if (tree.tiles().empty()) continue;
    // All tiles have the attributes of the scan that they are made of.
    const auto last = static_cast<std::uint32_t>(tree.tiles().size() - 1);
    RELIEF_TRY_ASSIGN(const PatchFile tile, tree.open_tile(last));
    const PatchFileInfo& info = tile.info();
    contents.have_seams |= info.is_joined;
    colours.are_there |= std::ranges::find(info.attributes, "colour") != info.attributes.end();
    colours.are_on_faces |= tree.tiles().size() == 1 && info.is_joined && !info.is_of_points;
  }
  return contents;
}

/// Adds what a view of an engine that draws patches shows.
void add_needs(const EngineEntry& engine, const RenderSettings& settings, PatchSections& sections) {
  const StoreNeeds needs = needs_of(engine.features(settings, ModelMaps(true)));
  sections.normals |= needs.normals || settings.clip.rule != ClipRule::Off;
  sections.colours |= needs.colours;
}

}  // namespace

Result<PatchSections> sections_of(const ScenePlan& plan, bool by_scalar,
                                  std::span<const EngineEntry> among) {
  if (!std::ranges::all_of(plan.models, names_patch_file, &SceneModel::file))
    return PatchSections{};
  RELIEF_TRY_ASSIGN(const Contents contents, contents_of(plan));
  ShownColours colours = contents.colours;
  colours.stand_for_numbers = by_scalar;
  // Seams follow the normals: without these they would be others, by the material.
  PatchSections sections{contents.have_seams, false, by_scalar};
  for (const PlannedView& view : plan.views) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(view, among));
    if (engine->forms.front() != ModelForm::Patches || engine->features == nullptr)
      return PatchSections{};
    RELIEF_TRY_ASSIGN(RenderSettings settings, look_of(plan, view, among));
    if (is_unlit_at_first(view.settings, colours)) settings.material = Material::Unlit;
    add_needs(*engine, settings, sections);
  }
  // What a scalar is painted into.
  if (by_scalar) sections.colours = false;
  return sections;
}

}  // namespace relief
