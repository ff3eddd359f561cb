// The picture in the window: coarse while it changes, then refined part by part.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/viewport.h"
#include "viewer/drawing/canvas.h"
#include "viewer/drawing/inspector.h"
#include "viewer/drawing/looks.h"
#include "viewer/drawing/pacer.h"
#include "viewer/drawing/point_cloud.h"

namespace relief {

/// Draws what a window shows. A change is drawn at once and coarsely; at rest the picture becomes
/// that of `relief render`, in bands that each take some tens of milliseconds, so that the window
/// answers in between.
class LivePicture {
 public:
  explicit LivePicture(const Gl& gl) : gl_(&gl) {}

  /// Shows from now on what an inspector makes of views, null: the views. It outlives the pictures
  /// that it draws. The looks are inspected().
  void inspect_with(Inspector* inspector) { inspector_ = inspector; }

  /// Draws all of it, at a quality, and waits for it. Refining begins anew.
  Status draw(Viewport& model, const Looks& looks, const Quality& quality);
  Status draw(const PointCloud& points, const Looks& looks, const Quality& quality);

  /// Draws the next band of the full picture: first with one sample a pixel, then with as many as
  /// the looks have; of points all at once. Does nothing once it is_complete(). `looks`: those of
  /// draw().
  Status refine(Viewport& model, const Looks& looks);
  Status refine(const PointCloud& points, const Looks& looks);
  [[nodiscard]] bool is_complete() const { return stage_ == Stage::Complete; }

  /// What the last whole picture with one sample a pixel took, in bands; once after each.
  [[nodiscard]] std::optional<double> take_still_ms() {
    return std::exchange(still_ms_, std::nullopt);
  }

  /// Begins to refine anew, as what is drawn has changed at rest. What is shown stays until it is
  /// drawn over. Returns whether it did: amid a first pass it does not, so that one comes to its
  /// end.
  bool restart();

  /// The newest picture; null before the first.
  [[nodiscard]] const Canvas* shown() const;

  /// Rows of shown() that are others than when this was asked last.
  [[nodiscard]] Rows take_new_rows() { return std::exchange(new_rows_, {}); }

 private:
  enum class Stage : std::uint8_t { OneSample, AllSamples, Complete };

  Status fit(std::optional<Canvas>& canvas, std::uint32_t width, std::uint32_t height);
  void show(const Canvas& canvas);
  Status draw_pane(Viewport& model, const Pane& pane, const Canvas& canvas);
  Status draw_band(Viewport& model, const Looks& looks, int samples, bool& is_last);

  const Gl* gl_;
  Inspector* inspector_ = nullptr;
  std::optional<Canvas> coarse_;
  std::optional<Canvas> full_;
  bool shows_full_ = false;
  Rows new_rows_;
  Stage stage_ = Stage::Complete;
  std::uint32_t next_row_ = 0;  ///< of the stage's next band
  double rows_per_ms_ = 4.0;    ///< of the last band
  double bands_ms_ = 0.0;       ///< of the stage's bands so far
  std::optional<double> still_ms_;
};

}  // namespace relief
