#include "viewer/input/measuring_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "viewer/drawing/display.h"
#include "viewer/drawing/probed_surface.h"

namespace relief {
namespace {

/// A cursor that has not moved for this long rests.
constexpr double kRestingSeconds = 0.1;

bool is_in(glm::dvec2 cursor, glm::ivec2 window) {
  return cursor.x >= 0.0 && cursor.y >= 0.0 && cursor.x < window.x && cursor.y < window.y;
}

/// The patch that a probed pixel shows.
std::optional<std::uint32_t> patch_of(const Image& pixel) {
  const Channel* const patch = pixel.find("patch");
  if (patch == nullptr || !(patch->values.front() > 0.0F)) return std::nullopt;
  return static_cast<std::uint32_t>(patch->values.front()) - 1;
}

/// What a pixel tells by itself. Of kernels, which have no patch, there is nothing more exact.
PickedPoint point_at(const ProbedSurface& surface, std::optional<std::uint32_t> patch) {
  PickedPoint picked;
  picked.is_exact = !patch;
  picked.point.position = surface.position();
  picked.point.normal = glm::dvec3(0.0);
  picked.point.patch = patch;
  picked.point.depth = surface.depth;
  return picked;
}

/// The patches that are shown, if they are in memory; otherwise null.
std::shared_ptr<const PatchModel> model_of(const Session& session) {
  if (session.scene == nullptr || session.scene->tiles != nullptr) return nullptr;
  return {session.scene, &session.scene->patches};
}

/// The patches beside a pixel.
std::vector<std::uint32_t> patches_about(glm::dvec2 cursor, Display& display,
                                         const Session& session) {
  constexpr std::array<glm::dvec2, 4> kNeighbours{
      {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}}};
  std::vector<std::uint32_t> patches;
  for (const glm::dvec2 step : kNeighbours) {
    if (!is_in(cursor + step, session.window)) continue;
    const auto pixel = display.probe(session, cursor + step);
    const auto patch = pixel ? patch_of(*pixel) : std::nullopt;
    if (patch) patches.push_back(*patch);
  }
  return patches;
}

}  // namespace

void toggle_measuring(Session& session) {
  if (session.measuring.chosen()) return session.measuring.put_away();
  session.measuring.choose(session.last_tool);
  session.asks_for_section = "Measure";
}

bool MeasuringInput::take(const Event& event, Session& session) {
  if (const auto* const move = std::get_if<MoveEvent>(&event)) {
    cursor_ = move->cursor;
    has_moved_ = true;
    return false;
  }
  const auto* const key = std::get_if<KeyEvent>(&event);
  if (key == nullptr || !key->pressed || key->modifiers.control) return false;
  switch (key->key) {
    case GLFW_KEY_M:
      toggle_measuring(session);
      return true;
    case GLFW_KEY_ESCAPE:
      return !session.shows_help && session.measuring.escape();
    case GLFW_KEY_BACKSPACE:
      return session.measuring.remove_last();
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return session.measuring.finish();
    default:
      return false;
  }
}

void MeasuringInput::click(glm::dvec2 cursor, bool is_double, double now, Display& display,
                           Session& session) {
  MeasuringTool& tool = session.measuring;
  if (!tool.chosen()) return;
  if (is_double) {  // its first click has added the point
    tool.finish();
    return;
  }
  const auto picked = pick(cursor, display, session);
  if (!picked) return;
  if (!picked->is_exact)
    add_message(session,
                "This point has single precision: " +
                    (tile_failure_.empty() ? "the surface is still being prepared" : tile_failure_),
                false, now);
  tool.add(picked->point);
}

bool MeasuringInput::hover(bool is_elsewhere, double now, Display& display, Session& session) {
  const std::shared_ptr<const PatchModel> shown = model_of(session);
  if (session.measuring.chosen())
    picker_.set_model(shown);
  else
    picker_.keep_only(shown.get());
  const bool is_exact = picker_.ready() != nullptr;
  const bool becomes_exact = is_exact && !was_exact_;
  was_exact_ = is_exact;
  const bool has_moved = std::exchange(has_moved_, false);
  if (is_elsewhere || has_moved || becomes_exact) {
    moved_at_ = now;
    is_searched_ = false;
  }
  const bool is_open = !session.measuring.open_points().empty();
  if (is_elsewhere || (has_moved && !is_open))
    return std::exchange(session.hovered, std::nullopt).has_value();
  if (is_searched_ || !is_in(cursor_, session.window)) return false;
  if (!is_open && now - moved_at_ < kRestingSeconds) return false;
  is_searched_ = true;
  session.hovered = pick(cursor_, display, session);
  return true;
}

double MeasuringInput::wait(double most) const {
  return is_searched_ ? most : std::min(most, kRestingSeconds);
}

std::optional<SurfacePoint> MeasuringInput::pick_exactly(const PickQuery& query,
                                                         const Session& session) {
  tile_failure_.clear();
  if (session.scene->tiles == nullptr) {
    tile_picker_.forget();
    const auto picker = picker_.ready();
    return picker ? picker->pick(query) : std::nullopt;
  }
  auto point = tile_picker_.pick(session.scene->tiles, query);
  if (point) return *point;
  tile_failure_ = point.error().message;
  return std::nullopt;
}

std::optional<PickedPoint> MeasuringInput::pick(glm::dvec2 cursor, Display& display,
                                                const Session& session) {
  const auto pixel = display.probe(session, cursor);
  const auto surface = pixel ? surface_of(*pixel, session, cursor) : std::nullopt;
  if (!surface) return std::nullopt;
  const auto patch = patch_of(*pixel);
  if (!patch) return point_at(*surface, patch);
  PickQuery query{surface->start, surface->direction, surface->depth, surface->pixel, *patch, {}};
  picker_.set_model(model_of(session));
  auto point = pick_exactly(query, session);
  // Without a picker the neighbours, each of which is drawn to be known, are of no use.
  if (!point && (session.scene->tiles != nullptr || picker_.ready() != nullptr)) {
    const auto others = patches_about(cursor, display, session);
    query.others = others;
    point = pick_exactly(query, session);
  }
  if (point) return PickedPoint{*point, true};
  return point_at(*surface, patch);
}

}  // namespace relief
