#include "renderer/viewport.h"

#include <cassert>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/engine_checks.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/image_parts.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/gl/drawing/saved_state.h"
#include "renderer/gl/open_gl.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief {
namespace {

/// Copies the target's colours, depths or both to where the part lies in the framebuffer.
void copy_pixels(const Gl& gl, const Targets& from, const Raster& part, GLuint framebuffer,
                 GLbitfield what) {
  const auto width = static_cast<GLint>(part.width);
  const auto height = static_cast<GLint>(part.height);
  const auto left = static_cast<GLint>(part.left);
  const auto bottom = static_cast<GLint>(part.bottom);
  gl.BlitNamedFramebuffer(from.framebuffer.id(), framebuffer, 0, 0, width, height, left, bottom,
                          left + width, bottom + height, what, GL_NEAREST);
}

/// An image's colour and alpha.
Texture make_colour(const Gl& gl, const Image& image) {
  std::vector<glm::vec4> rows(std::size_t{image.width} * image.height);  // the bottom row first
  glm::length_t component = 0;
  for (const char* const name : {"R", "G", "B", "A"}) {
    const Channel* const channel = image.find(name);
    assert(channel != nullptr && "an image has a colour");
    for (std::size_t y = 0; y < image.height; ++y) {
      for (std::size_t x = 0; x < image.width; ++x)
        rows[(image.height - 1 - y) * image.width + x][component] =
            channel->values[y * image.width + x];
    }
    ++component;
  }
  Texture texture = make_attachment(gl, "whole image", GL_RGBA16F, image.width, image.height);
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(image.width),
                       static_cast<GLsizei>(image.height), GL_RGBA, GL_FLOAT, rows.data());
  return texture;
}

}  // namespace

struct Viewport::Reused {
  std::optional<Targets> targets;

  /// The targets, if they fit.
  std::optional<Targets> take(std::uint32_t width, std::uint32_t height, const Outputs& outputs) {
    const bool fits = targets && targets->width == width && targets->height == height &&
                      targets->normal.has_value() == outputs.normal &&
                      targets->depth.has_value() == outputs.depth &&
                      targets->uv.has_value() == outputs.uv &&
                      targets->patch_id.has_value() == outputs.patch_id &&
                      targets->clip.has_value() == outputs.clip;
    return fits ? std::exchange(targets, std::nullopt) : std::nullopt;
  }
};

/// A part of a view whose targets are there and empty.
struct Viewport::BegunPart {
  GlPreparedModel& engine;
  const RenderSettings& settings;  ///< of the view, with one sample a pixel
  const Raster& raster;            ///< where the part lies in the view
  GlFrame& frame;
  PassTimer& timer;
};

Viewport::Viewport(const RenderModel& model, const PatchPool* pool,
                   std::span<const EngineEntry> among)
    : model_(model),
      pool_(pool),
      among_(among),
      environments_(std::make_shared<EnvironmentCache>()),
      reused_(std::make_unique<Reused>()) {}
Viewport::~Viewport() = default;

Result<std::unique_ptr<Viewport>> Viewport::create(const GlLoader& load, const RenderModel& model,
                                                   std::span<const RenderSettings> looks,
                                                   std::span<const EngineEntry> among,
                                                   CollectedStore* collected) {
  return make(load, model, nullptr, looks, among, collected);
}

Result<std::unique_ptr<Viewport>> Viewport::create(const GlLoader& load, const PatchModel& model,
                                                   const PatchPool& pool,
                                                   std::span<const RenderSettings> looks,
                                                   std::span<const EngineEntry> among) {
  return make(load, RenderModel::of(model), &pool, looks, among, nullptr);
}

Result<std::unique_ptr<Viewport>> Viewport::make(const GlLoader& load, const RenderModel& model,
                                                 const PatchPool* pool,
                                                 std::span<const RenderSettings> looks,
                                                 std::span<const EngineEntry> among,
                                                 CollectedStore* collected) {
  std::unique_ptr<Viewport> made(new Viewport(model, pool, among));
  RELIEF_TRY_ASSIGN(made->opengl_, OpenGl::adopt(load));
  std::map<std::string, std::vector<RenderSettings>> groups;
  for (const RenderSettings& look : looks) groups[look.engine].push_back(look);
  for (const auto& [name, views] : groups) {
    // Used up by the first.
    RELIEF_TRY(made->prepare(views, groups.size() == 1 ? collected : nullptr));
  }
  return made;
}

Status Viewport::prepare(std::span<const RenderSettings> looks, CollectedStore* collected) {
  const std::string& name = looks.front().engine;
  const SavedState saved(opengl_->gl());
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(name, among_));
  if (!is_for_viewports(*engine))
    return make_error("engine {} does not draw with OpenGL, which a viewport needs", name);
  for (const RenderSettings& look : looks) RELIEF_TRY(check_engine(*engine, look, model_, among_));
  RELIEF_TRY_ASSIGN(auto prepared, engine->prepare({.model = model_,
                                                    .views = looks,
                                                    .opengl = opengl_,
                                                    .environments = environments_,
                                                    .levels = KeptLevels::All,
                                                    .pool = pool_,
                                                    .collected = collected}));
  prepared_[name] = std::move(prepared);
  return {};
}

Result<std::unique_ptr<CollectedStore>> collect_for_viewport(const RenderModel& model,
                                                             std::span<const RenderSettings> looks,
                                                             const StoreLimits& limits,
                                                             const std::stop_token& stop,
                                                             std::span<const EngineEntry> among) {
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(looks.front().engine, among));
  const auto* const patches = model.find<PatchModel>();
  const bool is_one = std::ranges::all_of(
      looks, [&](const RenderSettings& look) { return look.engine == engine->name; });
  if (!is_one || patches == nullptr || engine->forms.front() != ModelForm::Patches ||
      engine->features == nullptr)
    return std::unique_ptr<CollectedStore>();
  const StoreNeeds needs = needs_of(looks, ModelMaps(*patches), engine->features);
  return CollectedStore::collect(limits, *patches,
                                 GlModel::order_for(*patches, looks, needs, KeptLevels::All), stop);
}

StoreNeeds pool_needs(const PatchModel& model, std::span<const RenderSettings> looks,
                      std::span<const EngineEntry> among) {
  const ModelMaps maps(model);
  StoreNeeds needs;
  for (const RenderSettings& look : looks) {
    const EngineEntry* const engine = find_engine(look.engine, among);
    if (engine == nullptr || engine->features == nullptr) continue;
    const StoreNeeds more = needs_of(engine->features(look, maps));
    needs.splats |= more.splats;
    needs.heights |= more.heights;
    needs.cells |= more.cells;
  }
  needs.normals = true;
  needs.colours = model.has_colours;
  needs.masks = needs.cells;
  needs.bodies = needs.cells;
  return needs;
}

bool is_for_viewports(const EngineEntry& engine) {
  return engine.capabilities.needs_opengl || !engine.surfaces_by.empty();
}

Result<PreparedModel*> Viewport::prepared_for(const RenderSettings& view) const {
  const auto found = prepared_.find(view.engine);
  if (found == prepared_.end())
    return make_error("engine {} is not among the looks of this viewport", view.engine);
  return found->second.get();
}

Result<GlPreparedModel*> Viewport::engine_for(const RenderSettings& view) const {
  RELIEF_TRY_ASSIGN(PreparedModel* const prepared, prepared_for(view));
  auto* const parts = dynamic_cast<GlPreparedModel*>(prepared);
  if (parts == nullptr)
    return make_error("engine {} has no fragments of patches to look into", view.engine);
  return parts;
}

Status Viewport::draw(const RenderSettings& view, std::uint32_t framebuffer) {
  return draw(view, {0, 0, view.width, view.height}, framebuffer);
}

Status Viewport::draw(const RenderSettings& view, const Rectangle& part,
                      std::uint32_t framebuffer) {
  RELIEF_TRY_ASSIGN(PreparedModel* const prepared, prepared_for(view));
  if (dynamic_cast<GlPreparedModel*>(prepared) == nullptr)
    return draw_whole(*prepared, view, part, framebuffer);
  const std::uint32_t side = samples_a_side(view.samples);
  const GLbitfield copied = GL_COLOR_BUFFER_BIT | (view.eye_dome > 0.0 ? GL_DEPTH_BUFFER_BIT : 0U);
  return draw_parts(view, part, [&](const BegunPart& begun) -> Status {
    const Gl& gl = opengl_->gl();
    if (side > 1) {
      RELIEF_TRY_ASSIGN(const Resolve* const resolve, begun.engine.model().resolve());
      begun.frame.resolve = {resolve, framebuffer, begun.raster};
    }
    RELIEF_TRY_ASSIGN(const auto drawing,
                      begun.engine.make_drawing(begun.frame, begun.settings, Counting::Off));
    draw_frame(gl, begun.frame, *drawing, begun.timer);
    if (side == 1) copy_pixels(gl, begun.frame.targets, begun.raster, framebuffer, copied);
    return {};
  });
}

Status Viewport::draw(const RenderSettings& view, const Rectangle& part, const PartReader& read) {
  const Counting counting = view.count_fragments ? Counting::On : Counting::Off;
  return draw_parts(view, part, [&](const BegunPart& begun) -> Status {
    const Gl& gl = opengl_->gl();
    RELIEF_TRY_ASSIGN(const auto drawing,
                      begun.engine.make_drawing(begun.frame, begun.settings, counting));
    if (drawing == nullptr)
      return make_error("fragments of semi-transparent surfaces are not counted");
    std::optional<Buffer> counts;
    if (counting == Counting::On)
      counts = draw_counting(gl, begun.frame, *drawing, CountsOf::Pixels);
    else
      draw_frame(gl, begun.frame, *drawing, begun.timer);
    return read(
        {begun.frame, begun.raster, begun.engine.model().store(), counts ? counts->id() : 0});
  });
}

Status Viewport::draw_parts(const RenderSettings& view, const Rectangle& part,
                            const PartDrawer& draw) {
  assert(part.left + part.width <= view.width && part.bottom + part.height <= view.height);
  RELIEF_TRY_ASSIGN(GlPreparedModel* const engine, engine_for(view));
  const Gl& gl = opengl_->gl();
  const SavedState saved(gl);
  RenderSettings settings = engine->settled(view);
  settings.samples = 1;
  const std::uint32_t side = samples_a_side(view.samples);
  PassTimer timer(gl);
  for (Raster raster : parts_of(part.width, part.height, side, largest_target(gl))) {
    raster.left += part.left;
    raster.bottom += part.bottom;
    RELIEF_TRY_ASSIGN(GlFrame frame, engine->model().make_frame(
                                         settings, raster,
                                         reused_->take(raster.width * side, raster.height * side,
                                                       settings.outputs)));
    RELIEF_TRY(draw({*engine, settings, raster, frame, timer}));
    reused_->targets = std::move(frame.targets);
  }
  return check_errors(gl, "the viewport");
}

Status Viewport::draw_whole(PreparedModel& engine, const RenderSettings& view,
                            const Rectangle& part, std::uint32_t framebuffer) {
  const Gl& gl = opengl_->gl();
  const SavedState saved(gl);
  RenderSettings alone = view;
  alone.outputs = {};
  alone.eye_dome = 0.0;
  Progress silent;
  RELIEF_TRY_ASSIGN(const RenderResult drawn, engine.render(alone, silent));
  const Texture colour = make_colour(gl, drawn.image);
  const Framebuffer whole =
      make_framebuffer(gl, "whole image", nullptr, {{RELIEF_OUT_COLOUR, &colour}});
  const auto left = static_cast<GLint>(part.left);
  const auto bottom = static_cast<GLint>(part.bottom);
  const auto right = static_cast<GLint>(part.left + part.width);
  const auto top = static_cast<GLint>(part.bottom + part.height);
  gl.BlitNamedFramebuffer(whole.id(), framebuffer, left, bottom, right, top, left, bottom, right,
                          top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  return check_errors(gl, "the viewport");
}

bool Viewport::draws_parts(const RenderSettings& view) const {
  return static_cast<bool>(engine_for(view));
}

double Viewport::depth_range(const RenderSettings& view) const {
  const auto engine = engine_for(view);
  if (!engine) return 0.0;
  const View shown = (*engine)->model().view_of(view);
  return shown.orthographic ? shown.far - shown.near : 0.0;
}

Result<Image> Viewport::probe(const RenderSettings& view, std::uint32_t x, std::uint32_t y) {
  assert(x < view.width && y < view.height);
  RELIEF_TRY_ASSIGN(PreparedModel* const prepared, prepared_for(view));
  const SavedState saved(opengl_->gl());
  return prepared->probe(view, x, y);
}

}  // namespace relief
