#include "viewer/drawing/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/image/srgb.h"
#include "loader/scene/first_look.h"
#include "renderer/eye_dome.h"
#include "viewer/choices/volume_choices.h"

namespace relief {
namespace {

/// sRGB of a window in which nothing is open: that of pictures' background.
constexpr float kEmpty = 0.25F;

/// Strength of eye-dome lighting of bare points: without it they have no shape, and with more the
/// gaps between them hide it.
constexpr double kShadeOfPoints = 0.05;

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

Result<std::unique_ptr<Display>> Display::create(const GlLoader& load) {
  RELIEF_TRY_ASSIGN(auto opengl, OpenGl::adopt(load));
  std::unique_ptr<Display> made(new Display(load, std::move(opengl)));
  RELIEF_TRY_ASSIGN(made->presenter_, Presenter::create(made->opengl_->gl()));
  return made;
}

bool Display::is_slow_to_show(const LoadedScene& scene, const Session& session) const {
  return is_slow_to_collect(scene) && looks_of(session, scene, chosen_looks(session));
}

std::unique_ptr<CollectJob> Display::collect(std::shared_ptr<const LoadedScene> scene,
                                             const Session& session) const {
  const auto looks = looks_of(session, *scene, chosen_looks(session));
  if (!looks) return nullptr;
  return std::make_unique<CollectJob>(std::move(scene), list_of(*looks),
                                      store_limits(opengl_->gl()), session.streaming.wake);
}

Status Display::show(std::shared_ptr<const LoadedScene> scene, Session& session,
                     CollectedStore* collected) {
  if (scene->has_kernels()) session.inspection = Inspection::Picture;
  RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session, *scene, chosen_looks(session)));
  RELIEF_TRY_ASSIGN(scene_,
                    UploadedScene::create(load_, scene, looks, session.streaming, collected));
  collecting_.reset();
  session.volume_values = values_of(*scene);
  session.scene = std::move(scene);
  pacer_.forget();
  points_.reset();
  is_steady_ = false;
  ready_ = chosen_looks(session);
  return {};
}

Status Display::show(const ScanPoints& points) {
  RELIEF_TRY_ASSIGN(points_, PointCloud::create(opengl_->gl(), points));
  collecting_.reset();  // nobody would take it
  is_steady_ = false;
  return {};
}

ChosenLooks Display::shown_looks(const Session& session) const {
  return is_collecting() ? ready_ : chosen_looks(session);
}

Result<Looks> Display::drawn_looks(const Session& session) const {
  return looks_of(session, *session.scene, shown_looks(session));
}

Status Display::change_look(Session& session) {
  if (collects(session)) return {};
  const std::unique_ptr<CollectJob> job = std::move(collecting_);
  return prepare(session, job ? job->collected() : nullptr);
}

/// Whether the session's looks have to wait for what is collected for them, which begins. What was
/// collected for others goes.
bool Display::collects(const Session& session) {
  const auto looks = looks_of(session);
  std::vector<std::vector<RenderSettings>> groups;
  if (looks && scene_->check(*looks)) groups = scene_->to_prepare(*looks);
  // Counting samples comes last: a look changes with each step of a slider.
  if (groups.size() != 1 || !is_slow_to_collect(*session.scene)) {
    collecting_.reset();
    return false;
  }
  if (collecting_ == nullptr || !scene_->are_alike(collecting_->looks(), groups.front())) {
    collecting_ = std::make_unique<CollectJob>(session.scene, std::move(groups.front()),
                                               store_limits(opengl_->gl()), session.streaming.wake);
  }
  return !collecting_->is_done();
}

Status Display::prepare(Session& session, CollectedStore* collected) {
  auto prepared = [&]() -> Status {
    RELIEF_TRY_ASSIGN(const Looks looks, looks_of(session));
    RELIEF_TRY(scene_->prepare(looks, collected));
    // What is read or compiled by the first image that needs it fails here, once.
    RELIEF_TRY(scene_->viewport().probe(looks.first, 0, 0));
    if (looks.second) RELIEF_TRY(scene_->viewport().probe(*looks.second, 0, 0));
    return {};
  }();
  if (prepared) {
    ready_ = chosen_looks(session);
  } else {
    session.look = ready_.left;
    session.compared = ready_.right;
    session.inspection = ready_.inspection;
  }
  is_steady_ = false;
  return prepared;
}

void Display::show_nothing(Session& session) {
  session.scene.reset();
  collecting_.reset();
  scene_.reset();
  points_.reset();
  picture_ = LivePicture(opengl_->gl());
  inspector_.reset();
}

Status Display::update(Session& session, bool changes) {
  pacer_.set_target(session.target_ms);
  if (is_complete() && !changes && !session.look_changed) return {};
  Status drawn = draw(session, changes);
  if (const Rows rows = picture_.take_new_rows(); !rows.empty()) {
    RELIEF_TRY(encode(session, rows));
  }
  return drawn;
}

Status Display::draw(Session& session, bool changes) {
  bool look_changes = std::exchange(session.look_changed, false);
  if (points_) {
    const Looks looks = looks_of_points(session);
    return changes ? picture_.draw(*points_, looks, pacer_.quality())
                   : picture_.refine(*points_, looks);
  }
  if (scene_ == nullptr) return {};
  if (look_changes) {
    RELIEF_TRY(change_look(session));
    look_changes = !is_collecting();
    is_steady_ = false;
  }
  RELIEF_TRY(choose_inspector(shown_looks(session).inspection));
  RELIEF_TRY_ASSIGN(const Looks looks, drawn_looks(session));
  depth_scale_ = eye_dome_scale(looks.first.camera) * scene_->viewport().depth_range(looks.first);
  Status drawn = changes || look_changes
                     ? picture_.draw(scene_->viewport(), looks, pacer_.quality())
                     : picture_.refine(scene_->viewport(), looks);
  if (const auto still = picture_.take_still_ms()) pacer_.note_still(*still);
  if (!drawn && inspector_) {
    session.inspection = Inspection::Picture;
    session.look_changed = true;
  }
  note_figures(session);
  return drawn;
}

Status Display::choose_inspector(Inspection inspection) {
  const bool is_needed = inspected_output(inspection).has_value();
  if (is_needed == inspector_.has_value() && (!inspector_ || inspector_->what() == inspection))
    return {};
  picture_.inspect_with(nullptr);
  inspector_.reset();
  if (!is_needed) return {};
  RELIEF_TRY_ASSIGN(inspector_, Inspector::create(opengl_->gl(), inspection));
  picture_.inspect_with(&*inspector_);
  return {};
}

void Display::note_figures(Session& session) const {
  session.inspected.fragments_a_pixel.reset();
  if (!inspector_ || !picture_.is_complete() || inspector_->figures().covered == 0) return;
  session.inspected.fragments_a_pixel = static_cast<double>(inspector_->figures().fragments) /
                                        static_cast<double>(inspector_->figures().covered);
}

Status Display::encode(const Session& session, const Rows& rows) {
  const Canvas& canvas = *picture_.shown();
  if (points_)
    return presenter_->encode(canvas, {.shade = points_->is_lit() ? 0.0 : kShadeOfPoints}, rows);
  if (inspector_) return presenter_->encode(canvas, {}, rows);
  const bool has_depth = session.scene == nullptr || !session.scene->has_kernels();
  const auto how = [&](const SceneSettings& look) {
    return Presentation{.exposure = look.exposure.value_or(0.0),
                        .shade = has_depth ? look.eye_dome.value_or(0.0) : 0.0,
                        .depth_scale = depth_scale_};
  };
  const ChosenLooks looks = shown_looks(session);
  Presentation left = how(looks.left);
  if (looks.right) {
    Presentation right = how(*looks.right);
    left.to = right.from = session.divider.share;
    RELIEF_TRY(presenter_->encode(canvas, right, rows));
  }
  return presenter_->encode(canvas, left, rows);
}

bool Display::note_frame(double ms) {
  const bool was_steady = std::exchange(is_steady_, true);
  if (was_steady) pacer_.note(ms);
  return was_steady;
}

Result<bool> Display::stream(Session& session, bool moves) {
  session.stream.reset();
  StreamedPatches* const stream = scene_ ? scene_->stream() : nullptr;
  if (stream == nullptr) return false;
  RELIEF_TRY_ASSIGN(const Looks looks, drawn_looks(session));
  auto views = moves ? list_of(looks, pacer_.quality()) : list_of(looks);
  // As `relief render` reads them.
  const ChosenLooks shown = shown_looks(session);
  if (!asks_for_samples(shown.left)) views.front().samples = 1;
  if (shown.right && !asks_for_samples(*shown.right)) views.back().samples = 1;
  is_stale_ |= stream->update(views, kUploadMs);
  session.stream = stream->state();
  if (is_stale_ && picture_.restart()) is_stale_ = false;
  const std::vector<std::string> failures = stream->take_failures();
  if (!failures.empty()) return Error{failures.front()};
  return moves || !picture_.is_complete();
}

void Display::present(const Session& session) {
  const Canvas* const canvas = picture_.shown();
  if (canvas != nullptr) {
    presenter_->copy(*canvas, session.window);
    return;
  }
  const std::array<float, 4> grey{kEmpty, kEmpty, kEmpty, 1.0F};
  opengl_->gl().ClearNamedFramebufferfv(0, GL_COLOR, 0, grey.data());
}

std::optional<Image> Display::probe(const Session& session, glm::dvec2 cursor) {
  if (scene_ == nullptr || points_) return std::nullopt;
  const auto looks = drawn_looks(session);
  if (!looks) return std::nullopt;
  const bool is_second = looks->second && cursor.x >= looks->divider * session.window.x;
  const glm::uvec2 at = pixel_of(cursor, session.window);
  auto pixel = scene_->viewport().probe(is_second ? *looks->second : looks->first, at.x, at.y);
  return pixel ? std::optional<Image>(*std::move(pixel)) : std::nullopt;
}

}  // namespace relief
