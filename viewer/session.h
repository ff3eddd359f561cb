// What the user of a window has chosen, and what it shows: all that panels read and change.
#pragma once

#include <deque>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/scene/scene.h"
#include "renderer/settings.h"
#include "viewer/document/document.h"
#include "viewer/drawing/looks.h"
#include "viewer/drawing/uploaded_scene.h"
#include "viewer/navigation/navigator.h"

namespace relief {

/// A sentence for the user, which fades after some seconds; errors stay longer.
struct Message {
  std::string text;
  bool is_error = false;
  double since = 0.0;  ///< the window's clock, seconds
};

struct Session {
  explicit Session(Document opened) : document(std::move(opened)) {}

  Document document;
  std::shared_ptr<const LoadedScene> scene;  ///< what is shown; null: points, or nothing yet
  Navigator navigator;

  SceneSettings look;                    ///< of the picture, but for its camera and size
  std::optional<SceneSettings> compared;  ///< the look right of the divider
  double divider = 0.5;

  bool shows_panels = true;
  bool shows_help = false;
  std::deque<Message> messages;  ///< the newest last

  /// Set by whoever changes a look; the picture is then drawn anew.
  bool look_changed = true;

  StreamOptions streaming;             ///< of files that are read as views need them
  std::optional<StreamState> stream;  ///< of what is shown, if it is such a file

  glm::ivec2 window{0};  ///< its size in pixels
  double frame_ms = 0.0;  ///< of the last moving frame
};

void add_message(Session& session, std::string text, bool is_error, double now);

/// Returns the renderer's settings of a look for the window's size and the present camera, as
/// `relief render` completes them. Fails as render_settings_of() does.
Result<RenderSettings> settings_of(const Session& session, const SceneSettings& look);

/// Returns the settings of what the window shows. `session.scene` is not null.
Result<Looks> looks_of(const Session& session);

}  // namespace relief
