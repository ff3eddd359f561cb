// A model drawn into framebuffers of someone else's OpenGL context: what a window uses.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stop_token>
#include <string>

#include "common/error.h"
#include "common/image/image.h"
#include "renderer/engine_registry.h"
#include "renderer/gl/context/loader.h"
#include "renderer/model.h"
#include "renderer/settings.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/store_limits.h"
#include "renderer/view/view.h"

namespace relief {

class CollectedStore;
class EnvironmentCache;
class GlPreparedModel;
class OpenGl;
class PatchPool;
struct GlFrame;

/// Whether a viewport can have an engine: those on OpenGL, and those of volumes and 3D Gaussians,
/// which without a GPU are as quick on the CPU.
[[nodiscard]] bool is_for_viewports(const EngineEntry& engine);

/// Pixels of an image, from its lower left corner.
struct Rectangle {
  std::uint32_t left = 0;
  std::uint32_t bottom = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// A part of a view that has just been drawn, while it is read.
struct DrawnPart {
  const GlFrame& frame;  ///< its targets hold what was drawn, its view is the part's
  Raster raster;         ///< where the part lies in the view
  const PatchStore& store;
  std::uint32_t counts = 0;  ///< buffer: fragments by pixel, as draw_counting() gives them; 0: none
};

using PartReader = std::function<Status(const DrawnPart& part)>;

/// A model on the GPU, uploaded once with all its levels, and drawn from any view into any
/// framebuffer. The OpenGL 4.5 core context belongs to the caller: it is current on this thread,
/// with no error pending, whenever a function of the viewport is called, the destructor's call
/// among them. The viewport never makes a context current and never destroys one.
///
/// OpenGL's state is afterwards what it was before, but for these, which are unbound: texture units
/// 0 to 26, uniform buffers 0 to 2, storage buffer 0.
class Viewport {
 public:
  /// Uploads the model, which must outlive the viewport. `looks`: the engines, primitives,
  /// interpolations, materials, lights and outputs that draw() will be given; their cameras and
  /// sizes do not matter. `among` must outlive the viewport, too. `collected`: what
  /// collect_for_viewport() made of them, used up. Fails if OpenGL is older than 4.5 or lacks
  /// memory, or an engine of `looks` does not draw this model with OpenGL.
  static Result<std::unique_ptr<Viewport>> create(const GlLoader& load, const RenderModel& model,
                                                  std::span<const RenderSettings> looks,
                                                  std::span<const EngineEntry> among = engines(),
                                                  CollectedStore* collected = nullptr);

  /// The same for a model whose patches come and go. `pool` has them, was made in the same context
  /// for what the looks need (pool_needs()), and outlives the viewport; `model` has no patches, and
  /// the bounds and attributes of all.
  static Result<std::unique_ptr<Viewport>> create(const GlLoader& load, const PatchModel& model,
                                                  const PatchPool& pool,
                                                  std::span<const RenderSettings> looks,
                                                  std::span<const EngineEntry> among = engines());

  /// Makes an engine anew, or adds it, for all that it is to draw from now on: `looks` name one
  /// engine. Other engines stay as they are, and all do if it fails, as create() does.
  Status prepare(std::span<const RenderSettings> looks, CollectedStore* collected = nullptr);

  ~Viewport();
  Viewport(const Viewport&) = delete;
  Viewport& operator=(const Viewport&) = delete;

  /// Draws a view into the lower left `view.width` times `view.height` pixels of the framebuffer's
  /// colour attachment: linear light, premultiplied, alpha the model's coverage. (OpenGL encodes it
  /// as sRGB if the framebuffer is such and GL_FRAMEBUFFER_SRGB is enabled.) `view.samples` samples
  /// a pixel. Does not wait for OpenGL. The pixels are those of render() without eye-dome lighting;
  /// for that, with `view.eye_dome` above 0 and one sample a pixel, the framebuffer's depth
  /// (GL_DEPTH_COMPONENT32F) becomes that of the opaque surfaces, reversed; otherwise it stays.
  /// Targets are made anew when the size or the outputs change. An engine of volumes and
  /// 3D Gaussians draws whole images (draws_parts()) and leaves the depth as it is.
  Status draw(const RenderSettings& view, std::uint32_t framebuffer);

  /// Draws a rectangle of the view into the same pixels of the framebuffer, which but for rounding
  /// are those that draw() gives them. What lies beside it stays as it was, and costs nothing if
  /// the engine draws_parts().
  Status draw(const RenderSettings& view, const Rectangle& part, std::uint32_t framebuffer);

  /// Draws a rectangle of the view, and gives each part of it with its outputs to `read`, which may
  /// draw: OpenGL's state is restored after it. `view.samples` samples a pixel, which are not
  /// averaged. With `view.count_fragments` what is drawn are the counts; fails if the look has
  /// semi-transparent surfaces, whose fragments are not counted, and if the engine draws whole
  /// images.
  Status draw(const RenderSettings& view, const Rectangle& part, const PartReader& read);

  /// Returns whether the engine of a look draws a rectangle without all of the image.
  [[nodiscard]] bool draws_parts(const RenderSettings& view) const;

  /// Returns how far apart, in world units, what depth values of 1 and 0 stand for is; 0 for a
  /// perspective view, whose depth values are not linear. The engine is among those of the looks.
  [[nodiscard]] double depth_range(const RenderSettings& view) const;

  /// Reads what one pixel of the view shows, `x` and `y` from the lower left corner: an image of
  /// one pixel with the channels of colour, "Z" and "patch" (common/image/image.h). Draws that
  /// pixel alone and waits for it. Of kernels the depth is where half of what is behind is covered,
  /// and the colour is none.
  Result<Image> probe(const RenderSettings& view, std::uint32_t x, std::uint32_t y);

 private:
  struct BegunPart;
  using PartDrawer = std::function<Status(const BegunPart& part)>;
  struct Reused;  ///< the last part's targets

  Viewport(const RenderModel& model, const PatchPool* pool, std::span<const EngineEntry> among);
  static Result<std::unique_ptr<Viewport>> make(const GlLoader& load, const RenderModel& model,
                                                const PatchPool* pool,
                                                std::span<const RenderSettings> looks,
                                                std::span<const EngineEntry> among,
                                                CollectedStore* collected);
  Result<PreparedModel*> prepared_for(const RenderSettings& view) const;
  /// Of an engine that draws parts.
  Result<GlPreparedModel*> engine_for(const RenderSettings& view) const;
  /// Copies a rectangle of a view that is drawn as a whole.
  Status draw_whole(PreparedModel& engine, const RenderSettings& view, const Rectangle& part,
                    std::uint32_t framebuffer);
  /// Calls `draw` for each of the parts that a rectangle of a view is drawn in.
  Status draw_parts(const RenderSettings& view, const Rectangle& part, const PartDrawer& draw);

  RenderModel model_;
  const PatchPool* pool_;
  std::span<const EngineEntry> among_;
  std::shared_ptr<const OpenGl> opengl_;  ///< before what is made in it: the last to go
  std::shared_ptr<EnvironmentCache> environments_;
  std::map<std::string, std::unique_ptr<PreparedModel>, std::less<>> prepared_;  ///< by engine
  std::unique_ptr<Reused> reused_;
};

/// Returns what a pool has to hold for these looks of a model (Viewport::create), and for others
/// that differ in nothing but material, lights and outputs.
[[nodiscard]] StoreNeeds pool_needs(const PatchModel& model, std::span<const RenderSettings> looks,
                                    std::span<const EngineEntry> among = engines());

/// Collects what Viewport::create() or prepare() uploads for these looks: nearly all of its work,
/// on any thread, without OpenGL. Null where they have to do it all: for several engines, and for
/// those that draw no patches. The model outlives it. Fails as create() does, or if it is stopped.
Result<std::unique_ptr<CollectedStore>> collect_for_viewport(
    const RenderModel& model, std::span<const RenderSettings> looks, const StoreLimits& limits,
    const std::stop_token& stop = {}, std::span<const EngineEntry> among = engines());

}  // namespace relief
