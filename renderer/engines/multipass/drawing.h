// The passes of the engine `multipass`, what Table 1 of [Ochotta 2008] calls "standard" (Botsch et
// al. 2005, High-quality surface splatting on today's GPUs).
#pragma once

#include <vector>

#include "renderer/frame/splat_sums.h"
#include "renderer/engines/multipass/variant.h"
#include "renderer/frame/gl_frame.h"

namespace relief::multipass {

/// Draws a model into one frame:
/// 1. visibility: the depth of the quads that tile the surface, set back along the ray;
/// 2. accumulation: what is not behind that adds its normal and colour with Gaussian weights;
/// 3. shading: the sums are normalised and shaded, where pass 1 covers the image.
class Drawing final : public GlDrawing {
 public:
  /// `variant` must outlive it; `sums` were made for the frame and the variant's features.
  Drawing(const Variant& variant, SplatSums sums, double radius_factor);

  void draw(const GlFrame& frame, PassTimer& timer) const override;

 private:
  void draw_splats(const SplatPrograms& programs, const std::vector<SampleDraw>& draws) const;
  void accumulate(const Texture& visible_depth, const std::vector<SampleDraw>& draws) const;
  void shade(const GlFrame& frame) const;

  const Variant& variant_;
  SplatSums sums_;
  double radius_factor_;
};

}  // namespace relief::multipass
