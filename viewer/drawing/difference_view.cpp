#include "viewer/drawing/difference_view.h"

#include <utility>
#include <vector>

#include "renderer/frame/targets/targets.h"
#include "viewer/inspecting/difference_map.h"

namespace relief {

Result<bool> DifferenceView::update(Session& session, bool changes, bool is_complete,
                                    const Canvas* picture, double now) {
  if (session.inspection != Inspection::Difference || session.scene == nullptr) {
    tracer_.reset();
    rests_since_.reset();
    is_tracing_ = is_shown_ = false;
    session.inspected.psnr_db.reset();
    session.inspected.truth_share.reset();
    return false;
  }
  if (tracer_ != nullptr && tracer_->scene() != session.scene) tracer_.reset();
  if (changes || !is_complete || picture == nullptr) {
    if (tracer_ != nullptr) tracer_->cancel();
    is_tracing_ = is_shown_ = false;
    rests_since_ = now;
    session.inspected.psnr_db.reset();
    session.inspected.truth_share.reset();
    return false;
  }
  if (is_shown_) return false;
  if (!is_tracing_) {
    if (!rests_since_) rests_since_ = now;
    if (now - *rests_since_ < kTruthRests) return false;
    rests_since_.reset();
    is_shown_ = true;  // once, even if it fails
    RELIEF_TRY(begin(session));
    is_shown_ = false;
    is_tracing_ = true;
  }
  session.inspected.truth_share = tracer_->share();
  auto truth = tracer_->take();
  if (!truth) return false;
  is_tracing_ = false;
  is_shown_ = true;
  session.inspected.truth_share.reset();
  if (!*truth) return truth->error();
  RELIEF_TRY(show(**truth, session, *picture));
  return true;
}

Status DifferenceView::begin(Session& session) {
  RELIEF_TRY_ASSIGN(Looks looks, looks_of(session));
  std::vector<RenderSettings> views{truth_of(std::move(looks.first))};
  if (looks.second) views.push_back(truth_of(*std::move(looks.second)));
  if (tracer_ == nullptr) {
    tracer_ = std::make_unique<TruthTracer>(
        TruthModel{session.scene, session.document.plan(), session.document.options()}, wake_);
  }
  tracer_->begin(std::move(views));
  return {};
}

Status DifferenceView::show(const Truth& truth, Session& session, const Canvas& picture) {
  const Image shown = read_colour(*gl_, picture.colour, picture.width, picture.height);
  const Image& first = truth.images.front();
  const Image whole =
      truth.images.size() > 1 ? join_at(first, truth.images.back(), session.divider.share) : first;
  auto map = map_difference(shown, whole, session.look.exposure.value_or(0.0));
  if (!map) return make_error("the picture {}", map.error().message);
  gl_->TextureSubImage2D(picture.shown.id(), 0, 0, 0, static_cast<GLsizei>(map->width),
                         static_cast<GLsizei>(map->height), GL_RGBA, GL_UNSIGNED_BYTE,
                         map->pixels.data());
  session.inspected.psnr_db = map->psnr_db;
  session.inspected.truth = truth.is_input ? "the input's triangles" : "the patches' own triangles";
  return {};
}

}  // namespace relief
