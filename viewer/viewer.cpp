#include "viewer/viewer.h"

#include <algorithm>
#include <utility>

#include "common/heap.h"
#include "viewer/arrivals.h"
#include "viewer/distance_colours.h"
#include "viewer/drawing/difference_view.h"
#include "viewer/drawing/display.h"
#include "viewer/drawing/probed_surface.h"
#include "viewer/frame_log.h"
#include "viewer/input/fly_keys.h"
#include "viewer/input/measuring_input.h"
#include "viewer/input/reaction.h"
#include "viewer/panels/panels.h"
#include "viewer/picture_orders.h"
#include "viewer/remember.h"
#include "viewer/session.h"
#include "viewer/settings/settings_file.h"
#include "viewer/window/gui.h"
#include "viewer/window/window.h"

namespace relief {
namespace {

/// How often a window that rests looks for files that have changed and for Ctrl-C.
constexpr double kRestSeconds = 0.25;
/// How often progress is shown.
constexpr double kProgressSeconds = 0.1;
/// Frames after an event: panels open, close, light up and take keys over several.
constexpr int kFramesAfterEvent = 6;
/// A pause is no motion.
constexpr double kLongestStep = 0.1;
/// A hand that drags pauses for less. After that what is finer than moving pictures is read.
constexpr double kPauseSeconds = 0.15;

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
  Loop(Window& window, Gui& gui, Display& display, Session& session, FrameLog log)
      : window_(window), gui_(gui), display_(display), session_(session), log_(std::move(log)) {}

  void turn() {
    const double waits = is_busy()          ? 0.0
                         : is_progressing() ? kProgressSeconds
                                            : measuring_.wait(kRestSeconds);
    const std::vector<Event> events = window_.wait(waits);
    const double now = window_.seconds();
    const double passed = std::min(now - std::exchange(last_, now), kLongestStep);
    bool changes = take_size();
    changes |= take_arrivals(now);
    session_.is_preparing |= display_.is_collecting();
    session_.look_changed |= display_.has_collected();
    if (auto before = follow_distance(session_)) {
      report(display_.show(std::move(before), session_), now);
      changes = true;
    }
    for (const Event& event : events) {
      gui_.note(event);
      fly_keys_.note(event, gui_.wants_keys());
      changes |= react(event, now);
    }
    changes |= fly(passed);
    changes |= session_.navigator.advance(passed);
    if (changes) session_.preview.reset();  // the user takes the camera over
    changes |= play(passed, session_);
    if (drop_old_messages(session_, now)) frames_left_ = std::max(frames_left_, 1);
    if (take_picture(now, session_)) frames_left_ = kFramesAfterEvent;
    if (measuring_.hover(changes || gui_.wants_mouse() || pointer_.held, now, display_, session_))
      frames_left_ = std::max(frames_left_, 1);
    if (session_.window.x == 0 || session_.window.y == 0) return;  // minimised
    if (changes) moved_ = now;
    take_tiles(now);
    if (!events.empty() || changes) frames_left_ = kFramesAfterEvent;
    if (frames_left_ == 0 && display_.is_complete() && !is_progressing()) {
      rest();
      return;
    }
    is_resting_ = false;
    frames_left_ = std::max(frames_left_ - 1, 0);
    draw(changes, now);
    if (session_.wants_close) window_.close();
    window_.set_full_screen(session_.wants_full_screen);
  }

 private:
  [[nodiscard]] bool is_busy() const {
    return frames_left_ > 0 || arrivals_.is_ready() || !display_.is_complete() ||
           display_.has_tiles_to_take() || session_.navigator.moving() || session_.look_changed ||
           session_.preview || fly_keys_.is_flying();
  }
  [[nodiscard]] bool is_progressing() const {
    return session_.document.is_loading() || session_.is_preparing ||
           session_.picture_job != nullptr || difference_.is_busy() ||
           (session_.stream && session_.stream->waiting > 0);
  }

  bool take_size() {
    session_.scale = window_.scale();
    glm::ivec2 size = window_.size();
    size.x -= side_panel_width(session_, size.x);
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
    const TakenArrivals taken = arrivals_.take(window_.size(), now, display_, session_);
    if (taken.has_told) frames_left_ = kFramesAfterEvent;
    return taken.changes;
  }

  /// Returns whether the camera has moved.
  bool fly(double seconds) {
    if (!fly_keys_.is_flying()) return false;
    session_.navigator.fly(fly_keys_.direction(), seconds, fly_keys_.speed_factor(),
                           surface_finder()(0.5 * glm::dvec2(session_.window)));
    return true;
  }

  /// Of a file that is read as the view needs it.
  void take_tiles(double now) {
    const bool was_waiting = session_.stream && session_.stream->waiting > 0;
    const Result<bool> has_more = display_.stream(session_, now - moved_ < kPauseSeconds);
    if (!has_more) add_message(session_, has_more.error().message, true, now);
    if (!has_more || *has_more || was_waiting) frames_left_ = std::max(frames_left_, 1);
  }

  [[nodiscard]] SurfaceFinder surface_finder() const {
    return [this](glm::dvec2 cursor) -> std::optional<glm::dvec3> {
      const auto pixel = display_.probe(session_, cursor);
      const auto surface = pixel ? surface_of(*pixel, session_, cursor) : std::nullopt;
      return surface ? std::optional(surface->position()) : std::nullopt;
    };
  }

  bool react(const Event& event, double now) {
    const bool is_over_panel = gui_.wants_mouse();
    if (session_.compared && session_.scene != nullptr &&
        react_to(event, session_.window.x, session_.scale, !is_over_panel && !pointer_.held,
                 session_.divider))
      return true;
    const bool is_release =
        std::holds_alternative<ButtonEvent>(event) && !std::get<ButtonEvent>(event).pressed;
    const bool is_mouse =
        std::holds_alternative<ButtonEvent>(event) || std::holds_alternative<WheelEvent>(event);
    const bool is_key =
        std::holds_alternative<KeyEvent>(event) || std::holds_alternative<CharacterEvent>(event);
    if (is_mouse && is_over_panel && !(is_release && pointer_.held)) return false;
    if (is_key && gui_.wants_keys()) return false;
    if (measuring_.take(event, session_)) return false;
    const Reaction reaction = react_to(event, surface_finder(), pointer_, session_);
    if (!reaction.dropped.empty()) {
      const auto opened = reaction.adds_dropped
                              ? session_.document.add(reaction.dropped, session_.look)
                              : session_.document.open(reaction.dropped, session_.look);
      report(opened, now);
    }
    if (reaction.click)
      measuring_.click(*reaction.click, reaction.is_double, now, display_, session_);
    return reaction.changes;
  }

  void draw(bool moves, double now) {
    const double scale = display_.pacer().quality().scale;
    const bool changes = moves || session_.look_changed;
    const FrameKind kind = display_.is_empty()      ? FrameKind::Empty
                           : changes                ? FrameKind::Moving
                           : display_.is_complete() ? FrameKind::Panels
                                                    : FrameKind::Band;
    report(display_.update(session_, moves), now);
    // While a look is collected for, the picture is that of another.
    const bool is_final = display_.is_complete() && !display_.is_collecting();
    const auto compared = difference_.update(session_, changes, is_final, display_.picture(), now);
    if (!compared) add_message(session_, compared.error().message, true, now);
    if (!compared || *compared) frames_left_ = kFramesAfterEvent;  // its legend opens
    display_.present(session_);
    gui_.begin();
    show_panels(session_, panels_, now);
    gui_.end();
    window_.set_title(title_of(session_));
    window_.swap();
    if (std::exchange(session_.closes_files, false)) close_files();
    const double ms = 1000.0 * (window_.seconds() - now);
    log_.add(kind, ms, scale);
    if (changes && session_.scene != nullptr && display_.note_frame(ms)) session_.frame_ms = ms;
  }

  /// Not while panels read what is open.
  void close_files() {
    session_.document.close();
    follow_bookmarks(session_);
    arrivals_.forget();
    session_.is_preparing = false;
    session_.points_read = 0;
    session_.frame_ms = 0.0;
    display_.show_nothing(session_);
    frames_left_ = kFramesAfterEvent;
  }

  void rest() {
    if (!std::exchange(is_resting_, true)) return_free_memory();
    look_at_files();
  }

  void look_at_files() {
    if (!session_.document.has_changed_on_disk()) return;
    session_.inspected.scene_before.reset();
    session_.document.reload(session_.look);
  }

  void report(const Status& status, double now) {
    if (status) return;
    add_message(session_, status.error().message, true, now);
    frames_left_ = kFramesAfterEvent;
  }

  Window& window_;
  Gui& gui_;
  Display& display_;
  Session& session_;
  FrameLog log_;
  Arrivals arrivals_;
  DifferenceView difference_{display_.gl(), &Window::wake};
  PanelState panels_;
  Pointer pointer_;
  FlyKeys fly_keys_;
  MeasuringInput measuring_{&Window::wake};
  double last_ = 0.0;
  double moved_ = -kPauseSeconds;  ///< when the picture changed last
  int frames_left_ = kFramesAfterEvent;
  bool is_resting_ = false;
};

/// Gives a new session what is remembered. A file that is no settings is left aside.
void recall(Session& session) {
  const auto path = settings_path();
  if (!path) return;
  auto preferences = load_preferences(*path);
  if (preferences)
    apply_preferences(*std::move(preferences), session);
  else
    add_message(session, preferences.error().message + "; the window begins with its defaults",
                true, 0.0);
}

}  // namespace

Status run_viewer(ViewerOptions options) {
  FrameLog log;
  if (!options.frame_log.empty()) {
    RELIEF_TRY_ASSIGN(log, FrameLog::open(options.frame_log));
  }
  // What is first loads while the window opens.
  Session session(Document(std::move(options.load), &Window::wake));
  session.look = session.first_look = options.settings;
  session.streaming = {options.budget, &Window::wake};
  recall(session);
  if (options.target_ms) session.target_ms = *options.target_ms;
  if (!options.files.empty()) RELIEF_TRY(session.document.open(options.files, options.settings));
  WindowOptions opening{.title = title_of(session), .size = session.preferences.window};
  if (const auto& size = options.settings.size) opening.size = {size->width, size->height};
  RELIEF_TRY_ASSIGN(const auto window, Window::open(opening));
  RELIEF_TRY_ASSIGN(const auto display, Display::create(Window::loader()));
  Gui gui(*window);
  Loop loop(*window, gui, *display, session, std::move(log));
  while (!window->wants_close() && !options.is_interrupted()) loop.turn();
  // Nobody is there any more to read why they can't be written.
  (void)remember_settings(session, window->size());
  return {};
}

}  // namespace relief
