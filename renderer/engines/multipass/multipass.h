// The engine `multipass`: splats in three passes, what Table 1 of paper 001 calls "standard"
// (Botsch et al. 2005, High-quality surface splatting on today's GPUs).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/engines/multipass/sums.h"
#include "renderer/frame/gl_image.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/store/patch_store.h"

namespace relief::multipass {

/// A pass over the samples: as triangles, or as sprites and, where those would be too large for
/// OpenGL or reach behind the eye, as triangles.
struct SplatPrograms {
  Program all;
  std::optional<Program> large;  ///< with sprites
};

/// Draws a stored model:
/// 1. visibility: the depth of the quads that tile the surface, set back along the ray;
/// 2. accumulation: what is not behind that adds its normal and colour with Gaussian weights;
/// 3. shading: the sums are normalised and shaded, where pass 1 covers the picture.
/// The model, its store and `gl` must outlive the engine.
class Engine {
 public:
  /// `features` from renderer/features.h.
  static Result<Engine> create(const Gl& gl, const PatchStore& store, std::uint32_t features);

  /// Draws one frame of a picture that was cleared; the frame uniforms must be bound. `sums`: made
  /// for this picture and these features.
  void draw(const GlPicture& picture, const Sums& sums, double radius_factor,
            PassTimer& timer) const;

 private:
  Engine(const Gl& gl, const PatchStore& store, SplatPrograms visibility,
         SplatPrograms accumulation, Program shading);
  void draw_splats(const SplatPrograms& programs, const std::vector<SampleDraw>& draws,
                   double radius_factor) const;
  void accumulate(const Sums& sums, const Texture& visible_depth,
                  const std::vector<SampleDraw>& draws, double radius_factor) const;
  void shade(const GlPicture& picture, const Sums& sums) const;

  const Gl* gl_;
  SampleDraws samples_;
  SplatPrograms visibility_;
  SplatPrograms accumulation_;
  Program shading_;
  VertexArray nothing_;  ///< for the pass over the whole picture
};

}  // namespace relief::multipass
