#include "renderer/bench/shading_bound.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "renderer/frame/features.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/frame/variant_cache.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::bench_passes {
namespace {

/// What a surface needs that is rasterised somehow.
Features surface_features(const RenderSettings& settings, ModelMaps maps) {
  return scene_features(settings, maps).without(RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_FRONT);
}

std::uint32_t largest_patch(const PatchModel& model) {
  const auto largest = std::max_element(
      model.patches.begin(), model.patches.end(), [](const Patch& a, const Patch& b) {
        return std::size_t{a.width} * a.height < std::size_t{b.width} * b.height;
      });
  return static_cast<std::uint32_t>(largest - model.patches.begin());
}

/// The program of some features, and the model whose patch it shades.
struct BoundVariant {
  static Result<BoundVariant> create(const Gl& gl, const PatchStore& store, Features features) {
    RELIEF_TRY_ASSIGN(Program program, make_program(gl, "shading bound", "environment/screen.vert",
                                                    "bench/shading_bound.frag", features));
    return BoundVariant{&gl, SampleDraws(gl, store), std::move(program)};
  }

  const Gl* gl;
  SampleDraws samples;
  Program program;
};

class BoundDrawing final : public GlDrawing {
 public:
  BoundDrawing(const BoundVariant& variant, std::uint32_t patch, std::uint64_t pixels)
      : variant_(variant), patch_(patch), pixels_(pixels) {}

  /// Whole rows of pixels, and what is left of one.
  void draw(const GlFrame& frame, PassTimer& timer) const override {
    const Gl& gl = *variant_.gl;
    const Program& program = variant_.program;
    const ScopedPass pass(gl, timer, "shading bound");
    variant_.samples.look(frame.view, {patch_});
    const BoundModel bound(gl, variant_.samples, frame.environment);
    gl.Disable(GL_DEPTH_TEST);
    gl.UseProgram(program.id());
    gl.ProgramUniform1i(program.id(), RELIEF_UNIFORM_PATCH, static_cast<GLint>(patch_));
    const auto width = static_cast<GLsizei>(frame.targets.width);
    const auto rows = static_cast<GLsizei>(pixels_ / frame.targets.width);
    const auto rest = static_cast<GLsizei>(pixels_ % frame.targets.width);
    gl.Viewport(0, 0, width, rows);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (rest == 0) return;
    gl.Viewport(0, rows, rest, 1);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  const BoundVariant& variant_;
  std::uint32_t patch_;
  std::uint64_t pixels_;
};

class PreparedShadingBound final : public GlPreparedModel {
 public:
  PreparedShadingBound(std::unique_ptr<GlModel> model, std::uint32_t patch, std::uint64_t pixels)
      : GlPreparedModel(std::move(model)), patch_(patch), pixels_(pixels) {}

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& /*frame*/,
                                                  const RenderSettings& settings,
                                                  Counting counting) override {
    Features features = surface_features(settings, model().maps());
    if (counting == Counting::On) features |= RELIEF_FEATURE_COUNT_FRAGMENTS;
    RELIEF_TRY_ASSIGN(const BoundVariant* variant, variants_.get(model(), features));
    return std::unique_ptr<GlDrawing>(std::make_unique<BoundDrawing>(*variant, patch_, pixels_));
  }

 private:
  VariantCache<BoundVariant> variants_;
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
  auto on_gpu = GlModel::create({.opengl = std::move(opengl),
                                 .environments = std::make_shared<EnvironmentCache>(),
                                 .patches = model,
                                 .needs = needs});
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<GlPreparedModel>(
      std::make_unique<PreparedShadingBound>(std::move(*on_gpu), largest_patch(model), pixels));
}

}  // namespace relief::bench_passes
