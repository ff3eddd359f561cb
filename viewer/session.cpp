#include "viewer/session.h"

#include <algorithm>
#include <utility>

#include "common/scene/views/view_camera.h"
#include "common/transform.h"

#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"

namespace relief {
namespace {

constexpr std::size_t kMostMessages = 5;
constexpr double kNoteSeconds = 6.0;
constexpr double kErrorSeconds = 20.0;

/// Whether the settings say where a camera is.
bool has_camera(const SceneSettings& settings) {
  return settings.orbit || settings.eye || settings.target || settings.roll_degrees ||
         settings.zoom || settings.fov_degrees || settings.orthographic;
}

}  // namespace

void forget_camera(SceneSettings& look) {
  look.size.reset();
  look.orbit.reset();
  look.eye.reset();
  look.target.reset();
  look.up.reset();
  look.roll_degrees.reset();
  look.zoom.reset();
  look.fov_degrees.reset();
  look.orthographic.reset();
}

void start_camera(Session& session, const PatchModel& extent) {
  SceneSettings& look = session.look;
  session.navigator.set_model(without_patches(extent), false);
  if (look.up && !look.eye) session.navigator.set_up_axis(look.up);
  look.size = ImageSize{static_cast<std::uint32_t>(std::max(session.window.x, 1)),
                        static_cast<std::uint32_t>(std::max(session.window.y, 1))};
  if (has_camera(look)) {
    if (const auto camera = camera_for(look, extent)) session.navigator.set_camera(*camera);
  }
  forget_camera(look);
}

void add_message(Session& session, std::string text, bool is_error, double now) {
  session.messages.push_back({std::move(text), is_error, now});
  if (session.messages.size() > kMostMessages) session.messages.pop_front();
}

bool drop_old_messages(Session& session, double now) {
  return std::erase_if(session.messages, [now](const Message& m) {
           return now - m.since > (m.is_error ? kErrorSeconds : kNoteSeconds);
         }) > 0;
}

SceneSettings& edited_look(Session& session) {
  return session.compared && session.edits_compared ? *session.compared : session.look;
}

Result<RenderSettings> settings_of(const Session& session, const SceneSettings& look) {
  return settings_of(session, look, *session.scene);
}

Result<RenderSettings> settings_of(const Session& session, const SceneSettings& look,
                                   const LoadedScene& scene) {
  const ScenePlan& plan = session.document.plan();
  PlannedView view = plan.views.front();
  view.settings = look;
  // What a model says itself stays; the panels change the rest.
  for (std::size_t k = 0; k < view.options_of_models.size(); ++k)
    view.options_of_models[k] = overlay_options(look.options, plan.models[k].options);
  RELIEF_TRY_ASSIGN(RenderSettings settings, render_settings_of(plan, view, scene.patches));
  complete_look(view, scene, settings);
  settings.camera = session.navigator.camera();
  settings.environment_stance = session.navigator.stance();
  settings.width = static_cast<std::uint32_t>(session.window.x);
  settings.height = static_cast<std::uint32_t>(session.window.y);
  settings.outputs = {};
  return settings;
}

ChosenLooks chosen_looks(const Session& session) {
  return {session.look, session.compared, session.inspection};
}

Result<Looks> looks_of(const Session& session) {
  return looks_of(session, *session.scene, chosen_looks(session));
}

Result<Looks> looks_of(const Session& session, const LoadedScene& scene,
                       const ChosenLooks& chosen) {
  Looks looks;
  RELIEF_TRY_ASSIGN(looks.first, settings_of(session, chosen.left, scene));
  if (chosen.right) {
    RELIEF_TRY_ASSIGN(looks.second, settings_of(session, *chosen.right, scene));
  }
  looks.first = inspected(std::move(looks.first), chosen.inspection);
  if (looks.second) looks.second = inspected(*std::move(looks.second), chosen.inspection);
  looks.divider = session.divider.share;
  return looks;
}

}  // namespace relief
