#include "renderer/engines/surfel/drawing.h"

#include <cmath>
#include <glm/mat4x4.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "renderer/engines/surfel/select_surfels.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/shading/materials.h"
#include "renderer/view/cull_mode.h"
#include "shaders/surfel/layout.h"

namespace relief::surfel {
namespace {

/// The default of z_0 of section 3.2, in radii.
constexpr float kOffsetRadii = 1.0F;

shared::SurfelFrame surfel_frame(const View& view, const SurfelSettings& settings) {
  shared::SurfelFrame frame{};
  frame.clip_from_eye = glm::mat4(view.projection * glm::dmat4(view.rotation));
  const double fall = std::numbers::log2e / (settings.falloff * settings.falloff);
  frame.rule = {fall, settings.offset ? 0.0F : kOffsetRadii, settings.offset.value_or(0.0), 0.0};
  return frame;
}

SelectionRule selection_rule(const SurfelStore& store, const SurfelClip* clip, const View& view,
                             const RenderSettings& settings) {
  return {.curved = settings.surfel.curved,
          .hides_backs = hides_backs(store, view, settings),
          .sorted = settings.surfel.blend == SurfelBlend::Sorted,
          .clipped = clip == nullptr ? std::span<const std::uint8_t>() : clip->clipped,
          .all_clipped = clip != nullptr && settings.outputs.clip,
          .pixels_per_surfel = pixels_per_surfel_of(settings)};
}

/// Depth tests as all passes over surfels have them, while it lives.
class DepthTested {
 public:
  explicit DepthTested(const Gl& gl) : gl_(gl) {
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  }
  ~DepthTested() {
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
    gl_.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl_.DepthFunc(GL_LESS);
    gl_.Disable(GL_DEPTH_TEST);
  }
  DepthTested(const DepthTested&) = delete;
  DepthTested& operator=(const DepthTested&) = delete;

 private:
  const Gl& gl_;
};

/// Textures, bound while it lives; null: none.
class BoundTextures {
 public:
  explicit BoundTextures(const Gl& gl) : gl_(gl) {}
  ~BoundTextures() {
    for (const GLuint unit : units_) gl_.BindTextureUnit(unit, 0);
  }
  BoundTextures(const BoundTextures&) = delete;
  BoundTextures& operator=(const BoundTextures&) = delete;

  void bind(GLuint unit, const Texture* texture) {
    if (texture == nullptr) return;
    gl_.BindTextureUnit(unit, texture->id());
    units_.push_back(unit);
  }
  void bind(GLuint unit, const std::optional<Table>& table) {
    if (table) bind(unit, &table->texture);
  }

 private:
  const Gl& gl_;
  std::vector<GLuint> units_;
};

}  // namespace

bool hides_backs(const SurfelStore& store, const View& view, const RenderSettings& settings) {
  const bool is_seen = settings.cull == CullMode::Back || sees_from_outside(store.set, view);
  return may_hide_backs(settings, store.closed) && is_seen;
}

Drawing::Drawing(DrawingParts parts, SplatSums sums)
    : parts_(std::move(parts)), sums_(std::move(sums)) {}

void Drawing::draw(const GlFrame& frame, PassTimer& timer) const {
  const Gl& gl = parts_.gl;
  const SurfelStore& store = parts_.store;
  const DrawnSurfels drawn = select_surfels(
      store.set, frame.view, selection_rule(store, parts_.clip, frame.view, parts_.settings));
  if (!drawn.list.empty()) {
    gl.NamedBufferSubData(store.drawn.buffer.id(), 0,
                          static_cast<GLsizeiptr>(std::span(drawn.list).size_bytes()),
                          drawn.list.data());
  }
  const shared::SurfelFrame uniforms = surfel_frame(frame.view, parts_.settings.surfel);
  const Buffer block =
      make_buffer(gl, "surfel frame", std::span<const shared::SurfelFrame>(&uniforms, 1));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_SURFEL_BIND_FRAME, block.id());
  {
    const DepthTested tested(gl);
    BoundTextures bound(gl);
    bound.bind(RELIEF_SURFEL_TEXTURE_DRAWN, &store.drawn.texture);
    bound.bind(RELIEF_SURFEL_TEXTURE_AXES, &store.tables.axes.texture);
    bound.bind(RELIEF_SURFEL_TEXTURE_BENDS, &store.tables.bends.texture);
    bound.bind(RELIEF_SURFEL_TEXTURE_IDENTITIES, &store.tables.identities.texture);
    bound.bind(RELIEF_SURFEL_TEXTURE_COLOURS, store.tables.colours);
    bound.bind(RELIEF_SURFEL_TEXTURE_TEXCOORDS, store.tables.texcoords);
    bound.bind(RELIEF_SURFEL_TEXTURE_IMAGE, address(store.tables.image));
    if (parts_.clip != nullptr) {
      bound.bind(RELIEF_TEXTURE_CLIP_RANGES, &parts_.clip->ranges.texture);
      bound.bind(RELIEF_TEXTURE_CLIP_LINES, &parts_.clip->lines.texture);
    }
    {
      const ScopedPass pass(gl, timer, "visibility");
      gl.BindFramebuffer(GL_FRAMEBUFFER, sums_.visibility.id());
      draw_pass(drawn, &SurfelPrograms::visibility);
    }
    if (has_any(sums_)) {
      const ScopedPass pass(gl, timer, "accumulation");
      accumulate(frame, drawn);
    }
  }
  {
    const ScopedPass pass(gl, timer, "shading");
    shade(frame);
  }
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_SURFEL_BIND_FRAME, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
}

void Drawing::draw_pass(const DrawnSurfels& drawn, const Program SurfelPrograms::*program) const {
  for (const SurfelBatch& batch : drawn.batches) {
    const SurfelWays& way = parts_.ways[batch.kind.index()];
    way.shape->draw(way.programs->*program, batch.first, batch.count);
  }
}

void Drawing::accumulate(const GlFrame& frame, const DrawnSurfels& drawn) const {
  const bool sorted = parts_.settings.surfel.blend == SurfelBlend::Sorted;
  const SummingUp summing(parts_.gl, sums_, sorted ? SumBlend::Over : SumBlend::Add);
  BoundTextures bound(parts_.gl);
  if (sorted) bound.bind(RELIEF_TEXTURE_ENVIRONMENT, frame.environment);
  draw_pass(drawn, &SurfelPrograms::accumulation);
}

void Drawing::shade(const GlFrame& frame) const {
  draw_shading_pass(parts_.gl, sums_, parts_.shading, parts_.nothing, frame.environment,
                    {{RELIEF_TEXTURE_PATCH_IDS, address(sums_.materials)}});
}

}  // namespace relief::surfel
