// A window with an OpenGL context, by GLFW.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/error.h"
#include "renderer/gl/context/loader.h"
#include "viewer/window/events.h"

struct GLFWwindow;

namespace relief {

struct WindowOptions {
  std::string title = "Relief";
  glm::ivec2 size{1280, 800};  ///< screen coordinates
  bool debug = false;          ///< OpenGL debug context
};

/// The program's one window. Its OpenGL 4.5 core context is current on the thread that opened it,
/// which is the program's first thread.
class Window {
 public:
  /// Fails, with one sentence that says what to do, without a display or OpenGL 4.5.
  static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits until something happens, wake() is called or the time is over (0: does not wait; below
  /// 0: for ever), and returns what the user did.
  std::vector<Event> wait(double seconds);

  /// Ends a wait, from any thread.
  static void wake();

  /// The image's size in pixels; 0 while the window is minimised.
  [[nodiscard]] glm::ivec2 size() const;
  /// How large texts are to be drawn, 1 on a common screen, 2 on one of twice the density.
  [[nodiscard]] double scale() const;
  [[nodiscard]] double seconds() const;
  [[nodiscard]] bool wants_close() const;
  void close();
  /// Fills the screen that the window is on, or goes back to where it was.
  void set_full_screen(bool full);
  void set_title(const std::string& title);
  void set_clipboard(const std::string& text);
  void swap();

  [[nodiscard]] static GlLoader loader();
  [[nodiscard]] GLFWwindow* handle() const { return window_; }

 private:
  Window() = default;
  [[nodiscard]] glm::dvec2 cursor() const;
  void listen();

  GLFWwindow* window_ = nullptr;
  std::string title_;
  bool is_full_screen_ = false;
  glm::ivec2 place_{0};  ///< before it filled the screen, screen coordinates
  glm::ivec2 size_{0};
  std::vector<Event> events_;
};

}  // namespace relief
