#include "viewer/choices/engine_choices.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "renderer/viewport.h"

namespace relief {
namespace {

Primitive primitive_of(const SceneSettings& look, const EngineEntry& engine) {
  RenderSettings settings = default_settings(engine);
  for (const auto& [key, value] : look.options) {
    const EngineOption* const option = find_option(engine, key);
    if (option != nullptr && check_value(option->row, value)) option->set(settings, value);
  }
  return settings.primitive;
}

void drop_missing_materials(SceneSettings& look, const EngineEntry& engine) {
  const EngineCapabilities& can = engine.capabilities;
  const Primitive primitive = primitive_of(look, engine);
  if (!can.transparency.has(primitive)) look.opacity.reset();
  if (!can.two_interfaces.has(primitive)) look.interfaces.reset();
  if (look.material == Material::Split && !can.split_view.any()) look.material = Material::Lit;
}

}  // namespace

std::vector<const EngineEntry*> engines_for(const RenderModel& model) {
  constexpr std::array kKernels{ModelForm::Volume, ModelForm::Gaussians, ModelForm::VolumeParts};
  const bool has_kernels = std::any_of(kKernels.begin(), kKernels.end(),
                                       [&model](ModelForm form) { return model.has(form); });
  std::vector<const EngineEntry*> found;
  for (const EngineEntry& engine : engines()) {
    // One that draws no kernels would show the surfaces among them alone.
    const bool draws_all = !has_kernels || !engine.surfaces_by.empty();
    if (is_for_viewports(engine) && draws_all && form_for(engine, model)) found.push_back(&engine);
  }
  return found;
}

void choose_engine(SceneSettings& look, const EngineEntry& engine) {
  look.engine = engine.name;
  // Values that it has no option for stay for the engine that one comes back to.
  std::erase_if(look.options, [&engine](const auto& given) {
    const EngineOption* const option = find_option(engine, given.first);
    return option != nullptr && !check_value(option->row, given.second);
  });
  drop_missing_materials(look, engine);
}

void choose_value(SceneSettings& look, const EngineEntry& engine, const std::string& key,
                  const OptionValue& value) {
  look.options.insert_or_assign(key, value);
  drop_missing_materials(look, engine);
}

NumberChoice offered_range(const OptionRow& row) {
  NumberChoice range = row.range;
  if (row.key == "samples") range.max = std::min(range.max, double{kMostSamples});
  return range;
}

std::vector<int> offered_samples() {
  std::vector<int> counts;
  for (int side = 1; side * side <= kMostSamples; ++side) counts.push_back(side * side);
  return counts;
}

std::string label_of(std::string_view key) {
  std::string label(key);
  std::replace(label.begin(), label.end(), '-', ' ');
  if (!label.empty())
    label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
  return label;
}

}  // namespace relief
