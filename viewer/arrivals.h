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
  /// Takes what the document has read since the last call, or failed to. What takes long to upload
  /// is collected in the background first; of other files than before, the samples are shown
  /// meanwhile. `window`: the size to remember with the files.
  TakenArrivals take(glm::ivec2 window, double now, Display& display, Session& session);

  /// Whether take() has something to do although nothing arrives.
  [[nodiscard]] bool is_ready() const { return waiting_ != nullptr || is_collected(); }

  /// Forgets what is collected, as files are closed.
  void forget() {
    waiting_.reset();
    job_.reset();
  }

 private:
  [[nodiscard]] bool is_collected() const { return job_ != nullptr && job_->is_done(); }

  /// Its samples are shown first: collecting would take the cores that draw them.
  std::shared_ptr<const LoadedScene> waiting_;
  std::unique_ptr<CollectJob> job_;
};

}  // namespace relief
