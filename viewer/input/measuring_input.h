// From clicks, keys and a resting cursor to points of the surface.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "viewer/measuring/background_picker.h"
#include "viewer/measuring/tile_picker.h"
#include "viewer/session.h"
#include "viewer/window/events.h"

namespace relief {

class Display;

/// Puts the tool that was used last into the user's hand, or puts it away.
void toggle_measuring(Session& session);

/// Measures with the session's tool, and finds what is under a cursor that rests.
class MeasuringInput {
 public:
  /// `wake`: as BackgroundPicker's.
  explicit MeasuringInput(std::function<void()> wake) : picker_(std::move(wake)) {}

  /// Takes the keys of an open measurement, and notes where the cursor is. Returns whether the
  /// event goes no further.
  bool take(const Event& event, Session& session);

  /// Adds the surface at a click to the open measurement. A double click ends a polyline.
  void click(glm::dvec2 cursor, bool is_double, double now, Display& display, Session& session);

  /// Finds the surface under the cursor: once it has rested, or at once while a measurement is
  /// open. `is_elsewhere`: the camera moves, or the cursor is not for the picture. Returns whether
  /// there is something new to show.
  bool hover(bool is_elsewhere, double now, Display& display, Session& session);

  /// How long the window may wait for events, at most `most` seconds.
  [[nodiscard]] double wait(double most) const;

 private:
  [[nodiscard]] std::optional<PickedPoint> pick(glm::dvec2 cursor, Display& display,
                                                const Session& session);
  [[nodiscard]] std::optional<SurfacePoint> pick_exactly(const PickQuery& query,
                                                         const Session& session);

  /// Of what is shown, made when a tool is chosen or the cursor first rests on the surface: for the
  /// Dragon it takes 0.6 s of a processor and 42 MB.
  BackgroundPicker picker_;
  TilePicker tile_picker_;
  std::string tile_failure_;  ///< why the last pick in tiles is not exact
  glm::dvec2 cursor_{-1.0};
  bool has_moved_ = false;   ///< since the last hover()
  bool is_searched_ = true;  ///< what is under the cursor is known
  double moved_at_ = 0.0;    ///< the window's clock, seconds
  bool was_exact_ = false;   ///< whether the picker was ready then
};

}  // namespace relief
