#include "viewer/drawing/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/image/srgb.h"
#include "renderer/view/view.h"

namespace relief {
namespace {

/// sRGB of a window in which nothing is open: that of pictures' background.
constexpr float kEmpty = 0.25F;

/// Strength of eye-dome lighting of bare points: without it they have no shape.
constexpr double kShadeOfPoints = 1.0;

/// For uploading what was read, in a frame.
constexpr double kUploadMs = 8.0;

/// Looks of a picture of points, of which only camera, size and background count.
Looks looks_of_points(const Session& session) {
  Looks looks;
  looks.first.camera = session.navigator.camera();
  looks.first.width = static_cast<std::uint32_t>(session.window.x);
  looks.first.height = static_cast<std::uint32_t>(session.window.y);
  looks.first.background = glm::vec3(linear_from_srgb(kEmpty));
  return looks;
}

/// Pixels from the lower left corner.
glm::uvec2 pixel_of(glm::dvec2 cursor, glm::ivec2 window) {
  const glm::dvec2 last = glm::dvec2(window) - 1.0;
  return {static_cast<std::uint32_t>(std::clamp(std::floor(cursor.x), 0.0, last.x)),
          static_cast<std::uint32_t>(std::clamp(last.y - std::floor(cursor.y), 0.0, last.y))};
}

}  // namespace

Result<std::unique_ptr<Display>> Display::create(const GlLoader& load, double target_ms) {
  RELIEF_TRY_ASSIGN(auto opengl, OpenGl::adopt(load));
  std::unique_ptr<Display> made(new Display(load, std::move(opengl), target_ms));
  RELIEF_TRY_ASSIGN(made->presenter_, Presenter::create(made->opengl_->gl()));
  return made;
}

Status Display::show(std::shared_ptr<const LoadedScene> scene, Session& session) {
  const std::shared_ptr<const LoadedScene> before = std::exchange(session.scene, scene);
  auto view = [&]() -> Result<std::unique_ptr<UploadedScene>> {
    RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session));
    return UploadedScene::create(load_, std::move(scene), looks, session.streaming);
  }();
  if (!view) {
    session.scene = before;
    return view.error();
  }
  scene_ = *std::move(view);
  points_.reset();
  is_steady_ = false;
  drawn_looks_.emplace(session.look, session.compared);
  return {};
}

Status Display::show(const ScanPoints& points) {
  RELIEF_TRY_ASSIGN(points_, PointCloud::create(opengl_->gl(), points));
  is_steady_ = false;
  return {};
}

Status Display::prepare(Session& session) {
  const auto prepared = [&]() -> Status {
    RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session));
    return scene_->prepare(looks);
  }();
  if (prepared)
    drawn_looks_.emplace(session.look, session.compared);
  else
    std::tie(session.look, session.compared) = *drawn_looks_;
  is_steady_ = false;
  return prepared;
}

Status Display::update(Session& session, bool changes) {
  if (points_) {
    if (!changes) return {};
    return picture_.draw(*points_, looks_of_points(session), pacer_.quality());
  }
  if (scene_ == nullptr) return {};
  if (std::exchange(session.look_changed, false)) {
    changes = true;
    RELIEF_TRY(prepare(session));
  }
  RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session));
  if (changes) return picture_.draw(scene_->viewport(), looks, pacer_.quality());
  return picture_.refine(scene_->viewport(), looks);
}

Result<bool> Display::stream(Session& session) {
  session.stream.reset();
  StreamedPatches* const stream = scene_ ? scene_->stream() : nullptr;
  if (stream == nullptr) return false;
  RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session));
  std::vector<RenderSettings> views{looks.first};
  if (looks.second) views.push_back(*looks.second);
  is_stale_ |= stream->update(views, kUploadMs);
  session.stream = stream->state();
  if (is_stale_ && picture_.restart()) is_stale_ = false;
  const std::vector<std::string> failures = stream->take_failures();
  if (!failures.empty()) return Error{failures.front()};
  return !picture_.is_complete();
}

void Display::note_frame(double ms) {
  // What compiles shaders says nothing about the next frame.
  if (std::exchange(is_steady_, true)) pacer_.note(ms);
}

void Display::present(const Session& session) {
  const Canvas* const canvas = picture_.shown();
  if (canvas == nullptr) {
    const std::array<float, 4> grey{kEmpty, kEmpty, kEmpty, 1.0F};
    opengl_->gl().ClearNamedFramebufferfv(0, GL_COLOR, 0, grey.data());
    return;
  }
  Presentation how;
  how.exposure = session.look.exposure.value_or(0.0);
  how.shade = points_ ? kShadeOfPoints : 0.0;
  presenter_->draw(*canvas, session.window, how);
}

std::optional<Image> Display::probe(const Session& session, glm::dvec2 cursor) {
  if (scene_ == nullptr || points_) return std::nullopt;
  const auto looks = looks_of(session);
  if (!looks) return std::nullopt;
  const bool is_second = looks->second && cursor.x >= looks->divider * session.window.x;
  const glm::uvec2 at = pixel_of(cursor, session.window);
  auto pixel = scene_->viewport().probe(is_second ? *looks->second : looks->first, at.x, at.y);
  return pixel ? std::optional<Image>(*std::move(pixel)) : std::nullopt;
}

std::optional<glm::dvec3> surface_of(const Image& pixel, const Session& session,
                                     glm::dvec2 cursor) {
  const Channel* const depth = pixel.find("Z");
  if (depth == nullptr || !std::isfinite(depth->values.front())) return std::nullopt;
  const Camera& camera = session.navigator.camera();
  const View view = make_view(camera, static_cast<std::uint32_t>(session.window.x),
                              static_cast<std::uint32_t>(session.window.y), 0.0);
  // The middle of the pixel.
  const glm::dvec2 window(std::floor(cursor.x) + 0.5,
                          session.window.y - std::floor(cursor.y) - 0.5);
  return view.eye + ray_start(view, window) +
         static_cast<double>(depth->values.front()) * ray_through(view, window);
}

}  // namespace relief
