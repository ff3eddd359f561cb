#include "viewer/choices/differences.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "renderer/engine_registry.h"
#include "viewer/choices/engine_choices.h"
#include "viewer/choices/material_choices.h"

namespace relief {
namespace {

std::string text_of(const std::optional<OptionValue>& value) {
  if (!value) return "off";
  if (const auto* const number = std::get_if<double>(&*value))
    return fmt::format("{:.4g}", *number);
  return std::get<std::string>(*value);
}

std::string environment_of(const RenderSettings& drawn) {
  return drawn.environment.empty() ? "built-in" : drawn.environment.stem().string();
}

std::string lights_of(const LookInForce& look) {
  const bool is_own = look.asked.lights.has_value();
  if (look.drawn.lights.from_environment) return is_own ? "environment and own" : "environment";
  if (is_own) return "own";
  return look.drawn.lights.list.empty() ? "camera" : "sun";
}

std::string background_of(const RenderSettings& drawn) {
  if (has_backdrop(drawn)) return "environment";
  if (!drawn.background) return "none";
  const glm::vec3& c = *drawn.background;
  return fmt::format("{:.2g} {:.2g} {:.2g}", c.r, c.g, c.b);
}

/// Collects what differs.
class Collector {
 public:
  void add(std::string what, std::string first, std::string second) {
    if (first != second) list_.push_back({std::move(what), std::move(first), std::move(second)});
  }
  void add(std::string what, double first, double second) {
    add(std::move(what), fmt::format("{:.3g}", first), fmt::format("{:.3g}", second));
  }
  [[nodiscard]] std::vector<Difference> take() { return std::move(list_); }

 private:
  std::vector<Difference> list_;
};

bool shows(const RenderSettings& a, const RenderSettings& b, Material kind) {
  return a.material == kind && b.material == kind;
}

void add_materials(const RenderSettings& a, const RenderSettings& b, Collector& found) {
  found.add("material", choice_of(a.material, a.constants).name,
            choice_of(b.material, b.constants).name);
  const MaterialConstants& first = a.constants;
  const MaterialConstants& second = b.constants;
  if (shows(a, b, Material::Mirror) || shows(a, b, Material::Split))
    found.add("roughness", first.roughness, second.roughness);
  if (shows(a, b, Material::Glass)) {
    found.add("refraction", first.ior, second.ior);
    const auto text = [](const glm::vec3& c) {
      return fmt::format("{:.2g} {:.2g} {:.2g}", c.r, c.g, c.b);
    };
    found.add("absorption", text(first.absorption), text(second.absorption));
    found.add("interfaces", first.interfaces, second.interfaces);
  }
  found.add("opacity", first.opacity, second.opacity);
}

void add_engines(const RenderSettings& a, const RenderSettings& b, Collector& found) {
  found.add("engine", a.engine, b.engine);
  const EngineEntry* const first = find_engine(a.engine);
  const EngineEntry* const second = find_engine(b.engine);
  if (first == nullptr || second == nullptr) return;
  for (const EngineOption& option : first->options) {
    const EngineOption* const other = find_option(*second, option.row.key);
    if (other == nullptr) continue;
    std::string what = label_of(option.row.key);
    what.front() = option.row.key.front();
    found.add(std::move(what), text_of(option.get(a)), text_of(other->get(b)));
  }
}

/// What follows from an environment alone goes without saying.
void add_lights(const LookInForce& a, const LookInForce& b, Collector& found) {
  if (a.asked.lights || b.asked.lights) found.add("light", lights_of(a), lights_of(b));
  if (a.asked.ambient || b.asked.ambient)
    found.add("ambient", a.drawn.lights.ambient.g, b.drawn.lights.ambient.g);
}

void add_light(const LookInForce& a, const LookInForce& b, Collector& found) {
  found.add("environment", environment_of(a.drawn), environment_of(b.drawn));
  found.add("environment's rotation", a.asked.environment_rotation_degrees.value_or(0.0),
            b.asked.environment_rotation_degrees.value_or(0.0));
  if (shows(a.drawn, b.drawn, Material::Lit)) add_lights(a, b, found);
  found.add("eye dome", a.drawn.eye_dome, b.drawn.eye_dome);
  if (a.asked.background || b.asked.background)
    found.add("background", background_of(a.drawn), background_of(b.drawn));
  found.add("exposure", a.asked.exposure.value_or(0.0), b.asked.exposure.value_or(0.0));
}

}  // namespace

std::vector<Difference> differences_of(const LookInForce& first, const LookInForce& second) {
  Collector found;
  add_materials(first.drawn, second.drawn, found);
  add_engines(first.drawn, second.drawn, found);
  add_light(first, second, found);
  return found.take();
}

}  // namespace relief
