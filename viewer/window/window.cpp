#include "viewer/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cstdlib>

#include <utility>

namespace relief {
namespace {

constexpr int kGlMajor = 4;
constexpr int kGlMinor = 5;

/// What GLFW complained of last.
std::string complaint() {
  const char* text = nullptr;
  return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? std::string("no reason given")
                                                                 : std::string(text);
}

Modifiers modifiers_of(int mods) {
  return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

MouseButton button_of(int button) {
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::Right;
  return button == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::Middle : MouseButton::Left;
}

/// The screen that a place (screen coordinates) is on, or the first one.
GLFWmonitor* monitor_at(glm::ivec2 place) {
  int count = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  for (int k = 0; k < count; ++k) {
    glm::ivec2 low(0);
    glfwGetMonitorPos(monitors[k], &low.x, &low.y);
    const GLFWvidmode* const mode = glfwGetVideoMode(monitors[k]);
    if (mode == nullptr) continue;
    const glm::ivec2 high = low + glm::ivec2(mode->width, mode->height);
    if (place.x >= low.x && place.y >= low.y && place.x < high.x && place.y < high.y)
      return monitors[k];
  }
  return glfwGetPrimaryMonitor();
}

Modifiers held_modifiers(GLFWwindow* window) {
  const auto held = [window](int left, int right) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
  };
  return {held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
          held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
#if GLFW_VERSION_MAJOR == 3 && GLFW_VERSION_MINOR >= 4
  // Without this folder there is no Wayland, and its library would complain on standard error.
  if (std::getenv("XDG_RUNTIME_DIR") == nullptr) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  if (glfwInit() != GLFW_TRUE) {
    return make_error(
        "there is no display for a window ({}); `relief render FILE -o picture.png` needs none",
        complaint());
  }
  std::unique_ptr<Window> made(new Window);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, kGlMajor);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, kGlMinor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
  // The picture is made in framebuffers of its own, with depth and samples of its own.
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  made->window_ =
      glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
  if (made->window_ == nullptr) {
    return make_error(
        "this display gives no window with OpenGL {}.{} ({}); update the graphics driver, or set "
        "LIBGL_ALWAYS_SOFTWARE=1 to draw without one",
        kGlMajor, kGlMinor, complaint());
  }
  glfwMakeContextCurrent(made->window_);
  glfwSwapInterval(1);
  made->title_ = options.title;
  made->listen();
  return made;
}

Window::~Window() {
  if (window_ != nullptr) glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::listen() {
  glfwSetWindowUserPointer(window_, this);
  const auto owner = [](GLFWwindow* w) -> Window& {
    return *static_cast<Window*>(glfwGetWindowUserPointer(w));
  };
  static constexpr auto kOwner = owner;
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
    Window& self = kOwner(w);
    self.events_.push_back(ButtonEvent{button_of(button), action == GLFW_PRESS, modifiers_of(mods),
                                       self.cursor(), glfwGetTime()});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double /*x*/, double /*y*/) {
    Window& self = kOwner(w);
    self.events_.push_back(MoveEvent{self.cursor()});
  });
  // What the cursor has left is drawn again without its light.
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int /*entered*/) {
    Window& self = kOwner(w);
    self.events_.push_back(MoveEvent{self.cursor()});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    Window& self = kOwner(w);
    self.events_.push_back(WheelEvent{{x, y}, held_modifiers(w), self.cursor()});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int /*scancode*/, int action, int mods) {
    kOwner(w).events_.push_back(
        KeyEvent{key, action != GLFW_RELEASE, action == GLFW_REPEAT, modifiers_of(mods)});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
    kOwner(w).events_.push_back(CharacterEvent{static_cast<char32_t>(character)});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    kOwner(w).events_.push_back(DropEvent{{paths, paths + count}});
  });
}

std::vector<Event> Window::wait(double seconds) {
  if (seconds == 0.0)
    glfwPollEvents();
  else if (seconds < 0.0)
    glfwWaitEvents();
  else
    glfwWaitEventsTimeout(seconds);
  return std::exchange(events_, {});
}

void Window::wake() {
  glfwPostEmptyEvent();
}

glm::ivec2 Window::size() const {
  glm::ivec2 size(0);
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE)
    glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

double Window::scale() const {
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return x;
}

glm::dvec2 Window::cursor() const {
  glm::dvec2 at(0.0);
  glm::ivec2 screen(0);
  glm::ivec2 pixels(0);
  glfwGetCursorPos(window_, &at.x, &at.y);
  glfwGetWindowSize(window_, &screen.x, &screen.y);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  // Where pixels are denser than screen coordinates the two differ.
  return screen.x > 0 && screen.y > 0 ? at * glm::dvec2(pixels) / glm::dvec2(screen) : at;
}

double Window::seconds() const {
  return glfwGetTime();
}

bool Window::wants_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::set_full_screen(bool full) {
  if (full == std::exchange(is_full_screen_, full)) return;
  if (!full) {
    glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, size_.x, size_.y, GLFW_DONT_CARE);
    return;
  }
  glfwGetWindowPos(window_, &place_.x, &place_.y);
  glfwGetWindowSize(window_, &size_.x, &size_.y);
  GLFWmonitor* const monitor = monitor_at(place_ + size_ / 2);
  const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  if (mode == nullptr) return;
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

GlLoader Window::loader() {
  return [](const char* name) { return glfwGetProcAddress(name); };
}

}  // namespace relief
