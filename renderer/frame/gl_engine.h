// What an engine on OpenGL implements, and how its images are made.
#pragma once

#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/error.h"
#include "renderer/engine.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/frame/gl_model.h"

namespace relief {

enum class Counting : bool { Off, On };

/// A model on the GPU that an engine there has made ready.
class GlPreparedModel : public PreparedModel {
 public:
  explicit GlPreparedModel(std::unique_ptr<GlModel> model) : model_(std::move(model)) {}

  /// Draws the image once and reads it back; in parts if it is large, which see
  /// renderer/frame/image_parts.h. First, in frames of their own, counts its fragments, and last
  /// times `settings.frames` frames more, if that is asked for. Looks between parts and frames
  /// whether the user interrupts.
  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override;

  Result<Image> probe(const RenderSettings& settings, std::uint32_t x, std::uint32_t y) override;

  /// The settings as this engine reads them: what it does not offer has the value that it draws.
  [[nodiscard]] virtual RenderSettings settled(const RenderSettings& asked) const { return asked; }

  /// What draws the model into a frame that was made for these settings, which are settled. With
  /// Counting::On it counts the fragments that it shades; null if it can't.
  virtual Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                          const RenderSettings& settings,
                                                          Counting counting) = 0;

  /// Counts the fragments of a frame, if the settings ask for it and the engine can. Not of one
  /// that is explained: what counts would be in the explanation.
  Result<std::optional<std::uint64_t>> count_if_asked(const GlFrame& frame,
                                                      const RenderSettings& settings);

  /// What the frames of these settings took: `first`, which drew the image, unless more frames are
  /// to be timed. Fails if OpenGL complains.
  Result<RenderResult> measure(const GlFrame& frame, const GlDrawing& drawing,
                               const RenderSettings& settings, FrameTime first,
                               const Progress& progress) const;

  [[nodiscard]] GlModel& model() const { return *model_; }

 private:
  /// Draws one part of an image with one sample a pixel. `settings` are settled.
  Result<RenderResult> render_part(const RenderSettings& settings, const Raster& part,
                                   const Progress& progress);

  /// Draws an image with at least `asked.samples` samples a pixel, in a square grid: the frame is
  /// drawn that much larger, in parts if need be, and the mean of linear light and coverage is
  /// taken. Normal, depth, UV and patch, if asked for, are those of the pixels' middles, from a
  /// frame of one sample a pixel. The time is that of all these together.
  Result<RenderResult> render_supersampled(const RenderSettings& asked, Progress& progress);

  std::unique_ptr<GlModel> model_;  ///< first: what derived classes make of it goes before
};

/// Adds what drawing `drawn` took to what `all` did: times, fragments and what is explained.
void add_cost(const RenderResult& drawn, RenderResult& all);

/// Puts a part of an image in its place, and adds what it took to what the parts before it did.
/// `all` is empty before the first part.
void add_part(RenderResult drawn, const Raster& part, const RenderSettings& settings,
              std::optional<RenderResult>& all);

/// The whole image, one sample a pixel.
[[nodiscard]] inline Raster whole_of(const RenderSettings& settings) {
  return {0, 0, settings.width, settings.height, 1};
}

/// Makes a model ready for an engine, whose feature bits of an image features_of(settings, maps)
/// gives.
template <class Prepared, class FeaturesOf>
Result<std::unique_ptr<PreparedModel>> prepare_on_gpu(const PrepareRequest& request,
                                                      const FeaturesOf& features_of) {
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && request.opengl != nullptr && "patches, to be drawn with OpenGL");
  RELIEF_TRY_ASSIGN(
      auto on_gpu,
      GlModel::create({.opengl = request.opengl,
                       .environments = request.environments,
                       .patches = *patches,
                       .views = request.views,
                       .levels = request.levels,
                       .pool = request.pool,
                       .collected = request.collected,
                       .needs = needs_of(request.views, ModelMaps(*patches), features_of)}));
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(std::move(on_gpu)));
}

}  // namespace relief
