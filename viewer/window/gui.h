// Dear ImGui in a window.
#pragma once

#include "common/error.h"

namespace relief {

class Window;

/// The panels' context and look. Between begin() and end() ImGui's functions may be called.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin();
  /// Draws the panels into the window.
  void end();

  /// Whether what the user does is for a panel and not for the picture behind it.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keys() const;
};

}  // namespace relief
