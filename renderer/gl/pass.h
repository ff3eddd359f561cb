// A pass: one named section of a frame, with its time.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// OpenGL's timer: the nanoseconds of all passes since the last `take`.
class PassTimer {
 public:
  explicit PassTimer(const Gl& gl);

  /// Waits for the passes and sums their milliseconds; nothing if OpenGL has no timer.
  [[nodiscard]] std::optional<double> take();

 private:
  friend class ScopedPass;
  const Gl* gl_;
  bool available_;
  std::vector<Query> queries_;
};

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
  bool timed_;
};

}  // namespace relief
