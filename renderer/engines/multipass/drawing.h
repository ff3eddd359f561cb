// The passes of the engine `multipass`, what Table 1 of [Ochotta 2008] calls "standard" (Botsch et
// al. 2005, High-quality surface splatting on today's GPUs).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/engines/multipass/clip_tables.h"
#include "renderer/engines/multipass/variant.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/frame/splat_sums.h"

namespace relief::multipass {

/// Draws a model into one frame:
/// 1. visibility: the depth of the quads that tile the surface, set back along the ray;
/// 2. accumulation: what is not behind that adds its normal and colour with Gaussian weights;
/// 3. shading: the sums are normalised and shaded, where pass 1 covers the image.
/// With clip lines 1 and 2 end at these. Patches without any are drawn as ever.
class Drawing final : public GlDrawing {
 public:
  /// `variant` must outlive it, and so must `clip`, which is null unless the variant clips; `sums`
  /// were made for the frame and the variant's features.
  Drawing(const Variant& variant, SplatSums sums, double radius_factor, const ClipTables* clip);

  void draw(const GlFrame& frame, PassTimer& timer) const override;

 private:
  /// The draws of some patches, of both passes over the samples; `large` of sprites that would be
  /// too large.
  struct Draws {
    SampleDraw all;
    std::optional<SampleDraw> large;
  };
  /// Of a frame.
  struct AllDraws {
    Draws plain;
    std::optional<Draws> clipped;
  };

  [[nodiscard]] AllDraws make_draws(const View& view,
                                    const std::vector<std::uint32_t>& visible) const;
  [[nodiscard]] Draws make_draws_of(const View& view,
                                    const std::vector<std::uint32_t>& visible) const;
  void see(const AllDraws& draws) const;
  void draw_splats(const SplatPrograms& programs, const Draws& draws,
                   const PageTables& beside) const;
  void accumulate(const Texture& visible_depth, const AllDraws& draws) const;
  void shade(const GlFrame& frame) const;

  const Variant& variant_;
  SplatSums sums_;
  double radius_factor_;
  const ClipTables* clip_;
};

}  // namespace relief::multipass
