// From what the document's thread has read to the session and the display.
#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "viewer/drawing/display.h"
#include "viewer/session.h"

namespace relief {

/// What Arrivals::take() has done.
struct TakenArrivals {
  bool changes = false;   ///< something else is to be drawn
  bool has_told = false;  ///< there are new messages
};

/// Shows what was read.
class Arrivals {
 public:
  /// Takes what the document has read since the last call, or failed to. A surface with which an
  /// empty window begins is shown as points first, and itself in the next call: its upload takes
  /// longer than a user likes to look at nothing. `window`: the size to remember with the files.
  TakenArrivals take(glm::ivec2 window, double now, Display& display, Session& session);

  /// Whether take() has something to show although nothing arrives.
  [[nodiscard]] bool is_waiting() const { return waiting_ != nullptr; }

  /// Forgets what waits, as files are closed.
  void forget() { waiting_.reset(); }

 private:
  std::shared_ptr<const LoadedScene> waiting_;  ///< its points are shown
};

}  // namespace relief
