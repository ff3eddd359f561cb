#include "renderer/engines/volume/quad_drawing.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <optional>
#include <utility>
#include <vector>

#include "renderer/engines/volume/rule.h"
#include "renderer/engines/volume/shader_splats.h"
#include "renderer/gl/program.h"
#include "renderer/volume/splats/placement.h"

namespace relief::volume {
namespace {

/// Front to back; equals keep the cloud's order, so that the image is the same each time.
std::vector<PlacedSplat> sorted(const std::vector<PlacedSplat>& placed) {
  std::vector<std::pair<double, std::uint32_t>> keys(placed.size());
  for (std::uint32_t s = 0; s < keys.size(); ++s) keys[s] = {placed[s].footprint.depth, s};
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<PlacedSplat> ordered(placed.size());
  tbb::parallel_for(std::size_t{0}, keys.size(),
                    [&](std::size_t s) { ordered[s] = placed[keys[s].second]; });
  return ordered;
}

class QuadDrawing final : public VolumeDrawing {
 public:
  explicit QuadDrawing(const Gl& gl) : gl_(gl), nothing_(gl, "no attributes") {}

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& progress) override {
    if (!program_) {
      RELIEF_TRY_ASSIGN(
          program_, make_program(gl_, "volume quads", "volume/quad.vert", "volume/quad.frag", {}));
    }
    const std::vector<PlacedSplat> placed =
        sorted(place_splats(frame.cloud, frame.view, frame.footprints, progress));
    if (progress.cancelled()) return interrupted_error();
    if (placed.empty()) return {};
    RELIEF_TRY_ASSIGN(const Table splats, make_splat_table(gl_, shader_splats(frame, placed)));
    const shared::VolumeRule rule = shader_rule(frame);
    const Buffer rules =
        make_buffer(gl_, "volume rule", std::span<const shared::VolumeRule>(&rule, 1));
    const ScopedPass pass(gl_, timer, "volume quads");
    gl_.BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer.id());
    gl_.Viewport(0, 0, static_cast<GLsizei>(targets.width), static_cast<GLsizei>(targets.height));
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SPLATS, splats.texture.id());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_RULE, rules.id());
    gl_.Enable(GL_BLEND);
    gl_.BlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    gl_.UseProgram(program_->id());
    gl_.BindVertexArray(nothing_.id());
    // Six vertices a splat fit in 31 bits wherever its five texels did.
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * placed.size()));
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
    gl_.BlendFunc(GL_ONE, GL_ZERO);
    gl_.Disable(GL_BLEND);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_RULE, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SPLATS, 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return {};
  }

 private:
  const Gl& gl_;
  VertexArray nothing_;
  std::optional<Program> program_;
};

}  // namespace

bool is_for_quads(const VolumeFrame& frame) {
  return visibility_of(frame.cloud, frame.settings.volume.visibility) == VolumeVisibility::Sorted &&
         !frame.features.has(RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH);
}

std::unique_ptr<VolumeDrawing> make_quad_drawing(const Gl& gl) {
  return std::make_unique<QuadDrawing>(gl);
}

}  // namespace relief::volume
