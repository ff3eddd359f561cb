// Dear ImGui in a window.
#pragma once

#include <vector>

#include "common/error.h"
#include "viewer/window/events.h"

struct GLFWwindow;

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
  /// Notes what the user did before that. Dear ImGui has its own callbacks, but before 1.87 misses
  /// a key that was pressed and let go between two frames.
  void note(const Event& event);
  /// Draws the panels into the window.
  void end();

  /// Whether what the user does is for a panel and not for the picture behind it.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keys() const;

 private:
  GLFWwindow* window_;
  std::vector<int> tapped_;  ///< keys pressed since the last frame
};

}  // namespace relief
