// The inspection that shows how far the picture is off a ray-traced one.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "viewer/drawing/canvas.h"
#include "viewer/drawing/truth_tracer.h"
#include "viewer/session.h"

namespace relief {

/// How long a view rests before it is traced, seconds.
inline constexpr double kTruthRests = 0.5;

/// Follows the picture: once it is complete and has rested, traces the same view, and then shows
/// the difference in its place. While another inspection is chosen it keeps nothing.
class DifferenceView {
 public:
  /// `wake`: as TruthTracer's.
  DifferenceView(const Gl& gl, std::function<void()> wake) : gl_(&gl), wake_(std::move(wake)) {}

  /// Once a turn of the window's loop. `changes`: the picture is another than in the turn before.
  /// `picture`: null before there is one; its shown texture becomes the difference. `now`: seconds.
  /// Returns whether that has just happened. Fails if the view can't be traced.
  Result<bool> update(Session& session, bool changes, bool is_complete, const Canvas* picture,
                      double now);

  /// Whether it waits for the view to rest or for the tracer.
  [[nodiscard]] bool is_busy() const { return rests_since_.has_value() || is_tracing_; }

 private:
  Status begin(Session& session);
  Status show(const Truth& truth, Session& session, const Canvas& picture);

  const Gl* gl_;
  std::function<void()> wake_;
  std::unique_ptr<TruthTracer> tracer_;
  std::optional<double> rests_since_;  ///< while nothing has been begun
  bool is_tracing_ = false;
  bool is_shown_ = false;  ///< or has failed
};

}  // namespace relief
