// One picture of an engine on OpenGL: its targets, its uniforms, its frames and their times.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "common/error.h"
#include "renderer/frame/resolve.h"
#include "renderer/frame/targets.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/result.h"
#include "renderer/settings.h"
#include "renderer/shading/environment.h"
#include "renderer/view/view.h"

namespace relief {

/// What belongs to a picture, whatever engine draws it.
struct GlPicture {
  View view;
  Targets targets;
  Buffer uniforms;  ///< shared::Frame
  glm::vec3 background{0.0F};
  const Texture* environment = nullptr;         ///< what materials reflect, or null
  const Texture* rough_environments = nullptr;  ///< with several materials, some of them rough
  std::optional<Buffer> materials;              ///< shared::MaterialInfo of several materials
  const Texture* surroundings = nullptr;        ///< for the backdrop, or null
  const Backdrop* backdrop = nullptr;           ///< null: there is none in the picture
  std::optional<PartResolve> resolve;           ///< of a part that is drawn with several samples
};

/// Draws the model of one frame. The targets are bound and cleared, the frame uniforms bound.
using DrawModel = std::function<void(const GlPicture& picture, PassTimer& timer)>;

/// A picture and what draws it.
struct GlDrawing {
  GlPicture picture;
  DrawModel draw;
  DrawModel count;  ///< draws the same and counts the fragments that it shades; empty where the
                    ///< picture is explained, which has nothing that only counts, or layered
  DrawModel draw_over = {};  ///< draws what is not opaque over all else; empty if nothing is
};

/// How long a frame took.
struct FrameTime {
  double wall_ms = 0.0;          ///< from the first command until all have finished
  std::optional<double> gpu_ms;  ///< of the passes, by OpenGL's timer
};

/// Draws one frame and waits for it. `timer` has no passes of others.
FrameTime time_frame(const Gl& gl, const GlDrawing& drawing, PassTimer& timer);

/// Draws a frame that counts the fragments shaded by the model's passes.
std::uint64_t count_fragments(const Gl& gl, const GlDrawing& drawing);

/// Reads back what was drawn last, counts what the model covers and, if `opaque`, puts the
/// background under it.
void read_picture(const Gl& gl, const GlPicture& picture, bool opaque, RenderResult& result);

/// Draws a picture: once to count fragments (unless it is explained), once to warm up, then
/// `settings.frames` times for the clock. The result has no image yet.
Result<RenderResult> draw_picture(const Gl& gl, const GlDrawing& drawing,
                                  const RenderSettings& settings);

/// Counts what the model covers and, if `opaque`, puts the background under it.
void finish_coverage(bool opaque, RenderResult& result);

/// What `gl` says of itself.
[[nodiscard]] std::string renderer_name(const Gl& gl);

}  // namespace relief
