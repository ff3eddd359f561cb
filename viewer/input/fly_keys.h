// The keys that fly the camera, and which of them are held.
#pragma once

#include <glm/vec3.hpp>

#include "viewer/window/events.h"

namespace relief {

/// W, S: forwards and back; A, D: to the left and right; Q, E: down and up; Shift: faster.
///
/// A key that went down together with Control belongs to a shortcut. It does not fly, not even when
/// Control is let go first.
class FlyKeys {
 public:
  /// Notes an event. `is_taken`: a panel takes its key; what is let go counts all the same.
  void note(const Event& event, bool is_taken);

  /// Right, up and forwards, each -1 to 1; 0 at rest.
  [[nodiscard]] glm::dvec3 direction() const;
  [[nodiscard]] bool is_flying() const { return direction() != glm::dvec3(0.0); }
  /// Of the usual speed.
  [[nodiscard]] double speed_factor() const { return is_fast_ ? 3.0 : 1.0; }

 private:
  unsigned held_ = 0;  ///< a bit for each key that flies
  bool is_fast_ = false;
};

}  // namespace relief
