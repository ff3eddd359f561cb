#include "viewer/drawing/live_picture.h"

#include <algorithm>
#include <chrono>

namespace relief {
namespace {

/// A window that answers within a tenth of a second feels alive; a band leaves room for an input
/// event and the frame that it asks for.
constexpr double kBandMs = 30.0;
constexpr std::uint32_t kFewestRows = 16;

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

const Canvas* LivePicture::shown() const {
  const std::optional<Canvas>& canvas = shows_full_ ? full_ : coarse_;
  return canvas ? &*canvas : nullptr;
}

Status LivePicture::fit(std::optional<Canvas>& canvas, std::uint32_t width, std::uint32_t height) {
  if (canvas && canvas->width == width && canvas->height == height) return {};
  canvas.reset();
  RELIEF_TRY_ASSIGN(canvas, make_canvas(*gl_, width, height));
  return {};
}

/// All of it is new.
void LivePicture::show(const Canvas& canvas) {
  shows_full_ = full_ && &canvas == &*full_;
  new_rows_ = {0, canvas.height};
}

Status LivePicture::draw(Viewport& model, const Looks& looks, const Quality& quality) {
  const std::vector<Pane> panes = panes_of(looks, quality);
  const bool is_full = quality.scale == 1.0;
  std::optional<Canvas>& canvas = is_full ? full_ : coarse_;
  RELIEF_TRY(fit(canvas, panes.front().settings.width, panes.front().settings.height));
  if (inspector_ != nullptr) inspector_->begin();
  for (const Pane& pane : panes) RELIEF_TRY(draw_pane(model, pane, *canvas));
  gl_->Finish();
  show(*canvas);
  // At full size only levels of detail differ from one sample a pixel at rest.
  stage_ = Stage::OneSample;
  next_row_ = 0;
  return {};
}

Status LivePicture::draw(const PointCloud& points, const Looks& looks, const Quality& quality) {
  const std::vector<Pane> panes = panes_of(looks, quality);
  const RenderSettings& settings = panes.front().settings;
  const bool is_full = quality.scale == 1.0;
  std::optional<Canvas>& canvas = is_full ? full_ : coarse_;
  RELIEF_TRY(fit(canvas, settings.width, settings.height));
  points.draw(settings.camera, settings.background.value_or(glm::vec3(0.0F)),
              quality.scale * quality.scale, *canvas);
  gl_->Finish();
  show(*canvas);
  stage_ = is_full ? Stage::Complete : Stage::OneSample;
  return {};
}

Status LivePicture::refine(const PointCloud& points, const Looks& looks) {
  return is_complete() ? Status() : draw(points, looks, kQualities.front());
}

Status LivePicture::draw_pane(Viewport& model, const Pane& pane, const Canvas& canvas) {
  if (inspector_ == nullptr) return model.draw(pane.settings, pane.part, canvas.framebuffer.id());
  RenderSettings settings = pane.settings;
  settings.afar_factor = 1.0;  // what is drawn from afar has no levels, cells or samples
  return model.draw(settings, pane.part,
                    [&](const DrawnPart& part) { return inspector_->draw(part, canvas); });
}

Status LivePicture::draw_band(Viewport& model, const Looks& looks, int samples, bool& is_last) {
  const std::uint32_t height = looks.first.height;
  const bool has_parts =
      model.draws_parts(looks.first) && (!looks.second || model.draws_parts(*looks.second));
  const auto wanted =
      has_parts ? static_cast<std::uint32_t>(std::min(rows_per_ms_ * kBandMs, 1e5)) : height;
  const std::uint32_t rows = std::min(std::max(wanted, kFewestRows), height - next_row_);
  if (inspector_ != nullptr && next_row_ == 0) inspector_->begin();
  const auto start = std::chrono::steady_clock::now();
  for (Pane& pane : panes_of(looks, samples)) {
    // From the top, as one reads.
    pane.part.bottom = height - next_row_ - rows;
    pane.part.height = rows;
    RELIEF_TRY(draw_pane(model, pane, *full_));
  }
  gl_->Finish();
  const double ms = ms_since(start);
  rows_per_ms_ = rows / std::max(ms, 0.01);
  bands_ms_ = next_row_ == 0 ? ms : bands_ms_ + ms;
  if (shows_full_) {
    const Rows band{height - next_row_ - rows, height - next_row_};
    new_rows_ = new_rows_.empty() ? band
                                  : Rows{std::min(new_rows_.bottom, band.bottom),
                                         std::max(new_rows_.top, band.top)};
  }
  next_row_ += rows;
  is_last = next_row_ == height;
  return {};
}

bool LivePicture::restart() {
  if (stage_ == Stage::OneSample && next_row_ > 0) return false;
  stage_ = Stage::OneSample;
  next_row_ = 0;
  return true;
}

Status LivePicture::refine(Viewport& model, const Looks& looks) {
  if (is_complete()) return {};
  RELIEF_TRY(fit(full_, looks.first.width, looks.first.height));
  const bool is_first = stage_ == Stage::OneSample;
  bool is_last = false;
  RELIEF_TRY(draw_band(model, looks, is_first ? 1 : most_samples(looks), is_last));
  if (!is_last) return {};
  if (!shows_full_) show(*full_);
  next_row_ = 0;
  if (is_first) still_ms_ = bands_ms_;
  const bool has_more = is_first && most_samples(looks) > 1;
  stage_ = has_more ? Stage::AllSamples : Stage::Complete;
  // A band of several samples takes that many times as long.
  if (has_more) rows_per_ms_ /= most_samples(looks);
  return {};
}

}  // namespace relief
