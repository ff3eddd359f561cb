#include "renderer/bench/shading_bound.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "renderer/frame/engine_cache.h"
#include "renderer/frame/features.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::bench_passes {
namespace {

/// What a surface needs that is rasterised somehow.
std::uint32_t surface_features(const RenderSettings& settings, ModelMaps maps) {
  return scene_features(settings, maps) & ~RELIEF_FEATURE_SPRITE;
}

std::uint32_t largest_patch(const PatchModel& model) {
  const auto largest = std::max_element(
      model.patches.begin(), model.patches.end(), [](const Patch& a, const Patch& b) {
        return std::size_t{a.width} * a.height < std::size_t{b.width} * b.height;
      });
  return static_cast<std::uint32_t>(largest - model.patches.begin());
}

class Pass {
 public:
  static Result<Pass> create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
    Result<Program> program = make_program(gl, "shading bound", "environment/screen.vert",
                                           "bench/shading_bound.frag", features);
    if (!program) return program.error();
    return Pass(gl, store, std::move(*program));
  }

  /// Whole rows of pixels, and what is left of one.
  void draw(const GlPicture& picture, std::uint32_t patch, std::uint64_t pixels,
            PassTimer& timer) const {
    const ScopedPass pass(*gl_, timer, "shading bound");
    samples_.look(picture.view, {patch});
    const BoundModel bound(*gl_, samples_, picture.environment);
    gl_->Disable(GL_DEPTH_TEST);
    gl_->UseProgram(program_.id());
    gl_->ProgramUniform1i(program_.id(), RELIEF_UNIFORM_PATCH, static_cast<GLint>(patch));
    const auto width = static_cast<GLsizei>(picture.targets.width);
    const auto rows = static_cast<GLsizei>(pixels / picture.targets.width);
    const auto rest = static_cast<GLsizei>(pixels % picture.targets.width);
    gl_->Viewport(0, 0, width, rows);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    if (rest == 0) return;
    gl_->Viewport(0, rows, rest, 1);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  Pass(const Gl& gl, const PatchStore& store, Program program)
      : gl_(&gl), samples_(gl, store), program_(std::move(program)) {}

  const Gl* gl_;
  SampleDraws samples_;
  Program program_;
};

class Prepared final : public GlPreparedModel {
 public:
  Prepared(std::unique_ptr<GlModel> model, std::uint32_t patch, std::uint64_t pixels)
      : GlPreparedModel(std::move(model)), patch_(patch), pixels_(pixels) {}

  Result<GlDrawing> make_drawing(const RenderSettings& settings, const Raster& part) override {
    const std::uint32_t features = surface_features(settings, model().maps());
    auto picture = model().make_picture(settings, part);
    if (!picture) return picture.error();
    const auto draw_with = [this](const Pass& drawing) {
      return [this, &drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame, patch_, pixels_, timer);
      };
    };
    return passes_.make_drawing(model(), features, std::move(*picture), true, draw_with);
  }

 private:
  EngineCache<Pass> passes_;
  std::uint32_t patch_;
  std::uint64_t pixels_;
};

}  // namespace

Result<std::unique_ptr<GlPreparedModel>> prepare_shading_bound(std::shared_ptr<const OpenGl> opengl,
                                                               const PatchModel& model,
                                                               const RenderSettings& settings,
                                                               std::uint64_t pixels) {
  assert(!model.patches.empty() && "there is a patch to shade");
  StoreNeeds needs = needs_of(surface_features(settings, ModelMaps(model)));
  needs.splats = false;
  auto on_gpu = GlModel::create(std::move(opengl), model, {}, needs);
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<GlPreparedModel>(
      std::make_unique<Prepared>(std::move(*on_gpu), largest_patch(model), pixels));
}

}  // namespace relief::bench_passes
