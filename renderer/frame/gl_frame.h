// One frame on OpenGL: what it is drawn into and with, whatever engine draws the model.
#pragma once

#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/frame/targets/resolve.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/result.h"
#include "renderer/shading/environment/environment.h"
#include "renderer/view/view.h"

namespace relief {

/// What belongs to an image, or to a part of it, whatever engine draws it.
struct GlFrame {
  View view;
  Targets targets;
  Buffer uniforms;  ///< shared::Frame
  glm::vec3 background{0.0F};
  const Texture* environment = nullptr;         ///< what materials reflect, or null
  const Texture* rough_environments = nullptr;  ///< with several materials, some of them rough
  std::optional<Buffer> materials = {};         ///< shared::MaterialInfo of several materials
  const Texture* surroundings = nullptr;        ///< for the backdrop, or null
  const Backdrop* backdrop = nullptr;           ///< null: the image has none
  std::optional<PartResolve> resolve = {};      ///< of a part that is drawn with several samples
};

/// What an engine has made ready to draw the model into one frame, any number of times. The frame
/// and the prepared model must outlive it.
class GlDrawing {
 public:
  GlDrawing() = default;
  virtual ~GlDrawing() = default;
  GlDrawing(const GlDrawing&) = delete;
  GlDrawing& operator=(const GlDrawing&) = delete;

  /// Draws the model's opaque surfaces. The frame's targets are bound and cleared, its uniforms
  /// bound.
  virtual void draw(const GlFrame& frame, PassTimer& timer) const = 0;

  /// Draws what is not opaque over everything else.
  virtual void draw_over(const GlFrame& /*frame*/, PassTimer& /*timer*/) const {}
};

/// Draws one frame, without waiting for it: clears, draws the model and what is around it, and
/// averages samples. Leaves nothing bound.
void draw_frame(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing, PassTimer& timer);

/// How long a frame took.
struct FrameTime {
  double wall_ms = 0.0;          ///< from the first command until all have finished
  std::optional<double> gpu_ms;  ///< of the passes, by OpenGL's timer
};

/// Times a frame from its creation on.
class FrameClock {
 public:
  explicit FrameClock(const Gl& gl) : gl_(&gl), timer_(gl) {}

  [[nodiscard]] PassTimer& timer() { return timer_; }

  /// Waits for all commands; the next frame begins now.
  FrameTime finish();

 private:
  const Gl* gl_;
  PassTimer timer_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Draws one frame and waits for it.
FrameTime time_frame(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing);

/// Draws the frame `frames` times more, and puts the medians of their times into the result. Fails
/// if the user interrupts.
Status time_frames(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing, int frames,
                   const Progress& progress, RenderResult& result);

/// The number of fragments that the model's passes shade. `counting`: a drawing that counts them.
/// The frame has holes then, because early depth tests let fragments hide others that are then
/// discarded.
std::uint64_t count_fragments(const Gl& gl, const GlFrame& frame, const GlDrawing& counting);

enum class CountsOf : bool { Frame, Pixels };

/// Draws the frame with a drawing that counts. Returns the counts as shaders/include/counting.glsl
/// keeps them: pixels a row, then one count for all pixels or a count a pixel, lower row first.
Buffer draw_counting(const Gl& gl, const GlFrame& frame, const GlDrawing& counting, CountsOf of);

/// Reads back what was drawn last, counts what the model covers and, if `opaque`, puts the
/// background under it.
void read_frame(const Gl& gl, const GlFrame& frame, bool opaque, RenderResult& result);

/// Counts what the model covers and, if `opaque`, puts the background under it.
void finish_coverage(bool opaque, RenderResult& result);

}  // namespace relief
