#include "viewer/viewer.h"

#include <algorithm>
#include <utility>

#include "viewer/drawing/display.h"
#include "viewer/input.h"
#include "viewer/panels/panels.h"
#include "viewer/session.h"
#include "viewer/window/gui.h"
#include "viewer/window/window.h"

namespace relief {
namespace {

/// How often a window that rests looks for files that have changed and for Ctrl-C.
constexpr double kRestSeconds = 0.25;
/// How often progress is shown.
constexpr double kProgressSeconds = 0.1;
/// Frames after an event: panels open, close and light up over several.
constexpr int kFramesAfterEvent = 3;
/// A pause is no motion.
constexpr double kLongestStep = 0.1;

std::string title_of(const Session& session) {
  const auto& files = session.document.files();
  if (files.empty()) return "Relief";
  const std::string more =
      files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more" : std::string();
  return files.front().filename().string() + more + " - Relief";
}

/// The window's loop. Each turn waits for events, changes the session, makes the picture newer and
/// shows it; when there is nothing left to do it only waits.
class Loop {
 public:
  Loop(Window& window, Gui& gui, Display& display, Session& session)
      : window_(window), gui_(gui), display_(display), session_(session) {}

  void turn() {
    const double waits = is_busy() ? 0.0 : is_progressing() ? kProgressSeconds : kRestSeconds;
    const std::vector<Event> events = window_.wait(waits);
    const double now = window_.seconds();
    const double passed = std::min(now - std::exchange(last_, now), kLongestStep);
    bool changes = take_size();
    changes |= take_arrivals(now);
    for (const Event& event : events) changes |= react(event, now);
    if (!gui_.wants_keys()) changes |= fly(window_, passed, session_);
    changes |= session_.navigator.advance(passed);
    if (session_.window.x == 0 || session_.window.y == 0) return;  // minimised
    take_tiles(now);
    if (!events.empty() || changes) frames_left_ = kFramesAfterEvent;
    if (frames_left_ == 0 && display_.is_complete() && !session_.document.is_loading()) {
      look_at_files();
      return;
    }
    frames_left_ = std::max(frames_left_ - 1, 0);
    draw(changes || session_.look_changed, now);
  }

 private:
  [[nodiscard]] bool is_busy() const {
    return frames_left_ > 0 || !display_.is_complete() || display_.has_tiles_to_take() ||
           session_.navigator.moving() || session_.look_changed || is_flying(window_);
  }
  [[nodiscard]] bool is_progressing() const {
    return session_.document.is_loading() || !session_.messages.empty() ||
           (session_.stream && session_.stream->waiting > 0);
  }

  bool take_size() {
    const glm::ivec2 size = window_.size();
    if (size == session_.window || size.x == 0 || size.y == 0) {
      session_.window = size;
      return false;
    }
    session_.window = size;
    session_.navigator.set_image(
        {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)});
    return true;
  }

  bool take_arrivals(double now) {
    Arrival arrival = session_.document.take();
    for (std::string& note : arrival.notes) add_message(session_, std::move(note), false, now);
    if (arrival.failure) add_message(session_, *std::move(arrival.failure), true, now);
    if (arrival.points) {
      session_.navigator.set_model(arrival.points->extent, !arrival.is_other);
      report(display_.show(*arrival.points), now);
    }
    if (arrival.scene) {
      const bool is_first = arrival.is_other || session_.scene == nullptr;
      session_.navigator.set_model(without_patches(arrival.scene->patches), !is_first);
      report(display_.show(std::move(arrival.scene), session_), now);
    }
    const bool changes = arrival.points || arrival.scene;
    if (arrival.is_other) window_.set_title(title_of(session_));
    return changes;
  }

  /// Of a file that is read as the view needs it.
  void take_tiles(double now) {
    const bool was_waiting = session_.stream && session_.stream->waiting > 0;
    const Result<bool> has_more = display_.stream(session_);
    if (!has_more) add_message(session_, has_more.error().message, true, now);
    if (!has_more || *has_more || was_waiting) frames_left_ = std::max(frames_left_, 1);
  }

  bool react(const Event& event, double now) {
    const bool is_release =
        std::holds_alternative<ButtonEvent>(event) && !std::get<ButtonEvent>(event).pressed;
    const bool is_mouse = std::holds_alternative<ButtonEvent>(event) ||
                          std::holds_alternative<WheelEvent>(event);
    const bool is_key =
        std::holds_alternative<KeyEvent>(event) || std::holds_alternative<CharacterEvent>(event);
    if (is_mouse && gui_.wants_mouse() && !(is_release && pointer_.held)) return false;
    if (is_key && gui_.wants_keys()) return false;
    const SurfaceFinder surface = [this](glm::dvec2 cursor) -> std::optional<glm::dvec3> {
      const auto pixel = display_.probe(session_, cursor);
      return pixel ? surface_of(*pixel, session_, cursor) : std::nullopt;
    };
    const Reaction reaction = react_to(event, surface, pointer_, session_);
    if (!reaction.dropped.empty()) {
      const auto opened = reaction.adds_dropped
                              ? session_.document.add(reaction.dropped, session_.look)
                              : session_.document.open(reaction.dropped, session_.look);
      report(opened, now);
    }
    return reaction.changes;
  }

  void draw(bool changes, double now) {
    report(display_.update(session_, changes), now);
    display_.present(session_);
    gui_.begin();
    show_panels(session_, now);
    gui_.end();
    window_.swap();
    const double ms = 1000.0 * (window_.seconds() - now);
    if (changes) {
      session_.frame_ms = ms;
      display_.note_frame(ms);
    }
  }

  void look_at_files() {
    if (!session_.document.has_changed_on_disk()) return;
    session_.document.reload(session_.look);
  }

  void report(const Status& status, double now) {
    if (!status) add_message(session_, status.error().message, true, now);
  }

  Window& window_;
  Gui& gui_;
  Display& display_;
  Session& session_;
  Pointer pointer_;
  double last_ = 0.0;
  int frames_left_ = kFramesAfterEvent;
};

}  // namespace

Status run_viewer(ViewerOptions options) {
  // What is first loads while the window opens.
  Session session(Document(std::move(options.load), &Window::wake));
  session.look = options.settings;
  session.streaming = {options.budget, &Window::wake};
  if (!options.files.empty()) RELIEF_TRY(session.document.open(options.files, options.settings));
  RELIEF_TRY_ASSIGN(const auto window, Window::open({.title = title_of(session)}));
  RELIEF_TRY_ASSIGN(const auto display, Display::create(Window::loader(), options.target_ms));
  Gui gui(*window);
  Loop loop(*window, gui, *display, session);
  while (!window->wants_close() && !options.is_interrupted()) loop.turn();
  return {};
}

}  // namespace relief
