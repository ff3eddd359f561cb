#include "renderer/viewport.h"

#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/engine_checks.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/gl/open_gl.h"
#include "renderer/gl/saved_state.h"
#include "renderer/shading/environment_cache.h"

namespace relief {

struct Viewport::Reused {
  std::optional<Targets> targets;

  /// The targets, if they fit.
  std::optional<Targets> take(const RenderSettings& settings) {
    const Outputs& outputs = settings.outputs;
    const bool fits =
        targets && targets->width == settings.width && targets->height == settings.height &&
        targets->normal.has_value() == outputs.normal &&
        targets->depth.has_value() == outputs.depth && targets->uv.has_value() == outputs.uv &&
        targets->patch_id.has_value() == outputs.patch_id;
    return fits ? std::exchange(targets, std::nullopt) : std::nullopt;
  }
};

Viewport::Viewport() : reused_(std::make_unique<Reused>()) {}
Viewport::~Viewport() = default;

Result<std::unique_ptr<Viewport>> Viewport::create(const GlLoader& load, const RenderModel& model,
                                                   std::span<const RenderSettings> looks,
                                                   std::span<const EngineEntry> among) {
  std::unique_ptr<Viewport> made(new Viewport);
  RELIEF_TRY_ASSIGN(made->opengl_, OpenGl::adopt(load));
  made->environments_ = std::make_shared<EnvironmentCache>();
  const SavedState saved(made->opengl_->gl());
  std::map<std::string, std::vector<RenderSettings>> groups;
  for (const RenderSettings& look : looks) groups[look.engine].push_back(look);
  for (const auto& [name, views] : groups) {
    RELIEF_TRY_ASSIGN(const EngineEntry* engine, engine_named(name, among));
    if (!engine->capabilities.needs_opengl)
      return make_error("engine {} does not draw with OpenGL, which a viewport needs", name);
    for (const RenderSettings& view : views) RELIEF_TRY(check_engine(*engine, view, model, among));
    RELIEF_TRY_ASSIGN(made->prepared_[name], engine->prepare({.model = model,
                                                              .views = views,
                                                              .opengl = made->opengl_,
                                                              .environments = made->environments_,
                                                              .levels = KeptLevels::All}));
  }
  return made;
}

Status Viewport::draw(const RenderSettings& view, std::uint32_t framebuffer) {
  const auto found = prepared_.find(view.engine);
  if (found == prepared_.end())
    return make_error("engine {} is not among the looks of this viewport", view.engine);
  auto& engine = static_cast<GlPreparedModel&>(*found->second);
  const Gl& gl = opengl_->gl();
  const SavedState saved(gl);
  const RenderSettings settings = engine.settled(view);
  RELIEF_TRY_ASSIGN(GlFrame frame, engine.model().make_frame(settings, whole_of(settings),
                                                             reused_->take(settings)));
  RELIEF_TRY_ASSIGN(const auto drawing, engine.make_drawing(frame, settings, Counting::Off));
  PassTimer timer(gl);
  draw_frame(gl, frame, *drawing, timer);
  const auto width = static_cast<GLint>(settings.width);
  const auto height = static_cast<GLint>(settings.height);
  gl.BlitNamedFramebuffer(frame.targets.framebuffer.id(), framebuffer, 0, 0, width, height, 0, 0,
                          width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  reused_->targets = std::move(frame.targets);
  return check_errors(gl, "the viewport");
}

}  // namespace relief
