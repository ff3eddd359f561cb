// The section "Light": the environment and the lights.
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/choices/key_light.h"
#include "viewer/choices/path_completion.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/path_field.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr NumberChoice kAmbients{0.0, 1.0};
constexpr NumberChoice kRotations{-180.0, 180.0};

bool is_environment(const fs::path& path) {
  return has_extension(path, {".exr", ".hdr"});
}

void choose_environment(const fs::path& path, const PanelContext& panel) {
  std::error_code failed;
  const fs::path whole = fs::absolute(path, failed);
  edited_look(panel.session).environment = failed ? path : whole;
  panel.session.look_changed = true;
}

void environment_rows(const PanelContext& panel) {
  SceneSettings& look = edited_look(panel.session);
  const fs::path current = look.environment.value_or(fs::path());
  // What could be read has become the look's; what could not has not.
  if (!current.empty() && !panel.session.look_changed)
    remember(panel.session.preferences.recent_environments, current, kMostRecentEnvironments);
  std::vector<fs::path> files = panel.session.preferences.recent_environments;
  if (!current.empty() && std::find(files.begin(), files.end(), current) == files.end())
    files.insert(files.begin(), current);
  files.insert(files.begin(), fs::path());
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const fs::path& file : files)
    names.push_back(file.empty() ? std::string("Built-in") : file.filename().string());
  const auto at = std::find(files.begin(), files.end(), current) - files.begin();
  const auto chosen = choice_row(
      "Environment",
      "What mirrors and glass show. A file also lights what is lit, and is the background", names,
      static_cast<std::size_t>(at));
  if (chosen && files[*chosen].empty()) {
    look.environment.reset();
    panel.session.look_changed = true;
  } else if (chosen) {
    choose_environment(files[*chosen], panel);
  }
  panel.session.look_changed |=
      number_row({"Rotation", "Of the environment, about the model's up direction", kRotations, 0.0,
                  "%.0f\xC2\xB0"},
                 look.environment_rotation_degrees);
  const auto typed = show_path_field({"environment", "Path of an .exr or .hdr", is_environment},
                                     panel.state.environment);
  if (!typed) return;
  choose_environment(*typed, panel);
  clear(panel.state.environment);
}

bool key_rows(const Stance& stance, Light& light) {
  const KeyLight before = key_light_of(light, stance);
  std::optional<double> azimuth = before.azimuth_degrees;
  std::optional<double> elevation = before.elevation_degrees;
  std::optional<double> intensity = before.intensity;
  const KeyLight usual;
  bool changes = number_row({"Azimuth",
                             "0 is in front of the model, 90 to the right",
                             {-180.0, 180.0},
                             usual.azimuth_degrees,
                             "%.0f\xC2\xB0"},
                            azimuth);
  changes |= number_row(
      {"Elevation", "Above the horizon", {-89.0, 89.0}, usual.elevation_degrees, "%.0f\xC2\xB0"},
      elevation);
  changes |= number_row({"Intensity",
                         "Radiance of a white surface that faces the light",
                         {0.0, kMostIntensity},
                         usual.intensity,
                         "%.2f"},
                        intensity);
  if (changes) {
    light = light_of(
        {azimuth.value_or(usual.azimuth_degrees), elevation.value_or(usual.elevation_degrees),
         static_cast<float>(intensity.value_or(usual.intensity))},
        stance);
  }
  return changes;
}

bool light_rows(const RenderSettings& drawn, const Stance& stance, SceneSettings& look) {
  const bool from_environment = drawn.lights.from_environment;
  const bool is_sun = !look.lights && !drawn.lights.list.empty();
  const std::vector<std::string> names{
      from_environment ? "Environment" : (is_sun ? "Sun" : "At the camera"),
      from_environment ? "Environment and key light" : "Key light"};
  const auto chosen = choice_row(
      "Lights",
      "At the camera: a key light, a fill light and a rim light that follow it. Sun: from the "
      "west-north-west, over terrain",
      names, look.lights ? 1U : 0U);
  if (chosen == 0U) look.lights.reset();
  if (chosen == 1U) look.lights = std::vector<Light>{light_of({}, stance)};
  bool changes = chosen.has_value();
  const bool is_key = look.lights && look.lights->size() == 1 &&
                      look.lights->front().kind == LightKind::Directional;
  if (is_key) changes |= key_rows(stance, look.lights->front());
  std::optional<double> ambient;
  if (look.ambient) ambient = look.ambient->g;
  const double usual = from_environment ? 0.0 : double{Lights().ambient.g};
  if (number_row({"Ambient", "Light from all directions", kAmbients,
                  look.ambient ? usual : double{drawn.lights.ambient.g}, "%.2f"},
                 ambient)) {
    look.ambient.reset();
    if (ambient) look.ambient = glm::vec3(static_cast<float>(*ambient));
    changes = true;
  }
  return changes;
}

}  // namespace

void show_light(const PanelContext& panel) {
  Session& session = panel.session;
  if (session.scene == nullptr) return show_faint("There is no surface yet.");
  environment_rows(panel);
  const auto drawn = settings_of(session, edited_look(session));
  if (!drawn) return show_faint_wrapped(drawn.error().message.c_str());
  const bool is_lit = drawn->material == Material::Lit || drawn->material == Material::Split ||
                      !drawn->materials.empty();
  if (!is_lit) return show_faint_wrapped("Lights shine on lit materials only.");
  session.look_changed |= light_rows(*drawn, session.navigator.stance(), edited_look(session));
}

}  // namespace relief
