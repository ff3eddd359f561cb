// A pass: one named section of a frame, with its time.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/explanation/pass_time.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// The times of passes since the last `take`: by OpenGL's timer, which takes no time itself.
class PassTimer {
 public:
  /// `each`: of every pass, by the clock where OpenGL has no timer. OpenGL then finishes before and
  /// after a pass, so that frames take longer.
  explicit PassTimer(const Gl& gl, bool each = false);

  /// Waits for the passes and sums their milliseconds; nothing if OpenGL has no timer.
  [[nodiscard]] std::optional<double> take();
  /// Waits for the passes; of each its time, in their order. Empty without `each`.
  [[nodiscard]] std::vector<PassTime> take_each();

 private:
  friend class ScopedPass;
  const Gl* gl_;
  bool available_;
  bool each_;
  std::vector<Query> queries_;
  std::vector<PassTime> passes_;  ///< with `each_`; their times only by the clock
};

/// Draws `frames` frames by `draw` and returns the medians of their passes' times, those of one
/// name summed. By the clock where OpenGL has no timer. Fails as `draw` does, or if the user
/// interrupts.
Result<std::vector<PassTime>> time_passes(const Gl& gl, int frames, const Progress& progress,
                                          const std::function<Status(PassTimer&)>& draw);

/// While it lives, commands belong to the pass `name`: a debug group and a timer query together.
/// Passes do not nest (OpenGL's timer queries can't).
class ScopedPass {
 public:
  ScopedPass(const Gl& gl, PassTimer& timer, std::string_view name);
  ~ScopedPass();
  ScopedPass(const ScopedPass&) = delete;
  ScopedPass& operator=(const ScopedPass&) = delete;

 private:
  const Gl& gl_;
  PassTimer& timer_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace relief
