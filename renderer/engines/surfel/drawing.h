// The passes of the engine `surfel` ([Textured surfels], section 3).
#pragma once

#include <cstdint>
#include <optional>

#include "renderer/engines/surfel/programs.h"
#include "renderer/engines/surfel/select_surfels.h"
#include "renderer/engines/surfel/shapes.h"
#include "renderer/engines/surfel/surfel_clip.h"
#include "renderer/engines/surfel/surfel_tables.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/frame/splat_sums.h"
#include "renderer/settings.h"

namespace relief::surfel {

/// Surfels that are ready to be drawn: what does not depend on the view.
struct SurfelStore {
  SurfelSet set;
  SurfelTables tables;
  Table drawn;  ///< the list of a frame; rewritten by each
  bool closed = false;
};

/// Whether surfels that face away from the eye are left out.
[[nodiscard]] bool hides_backs(const SurfelStore& store, const View& view,
                               const RenderSettings& settings);

/// What draws each kind: shapes and programs.
struct SurfelWays {
  const Shape* shape = nullptr;
  const SurfelPrograms* programs = nullptr;  ///< null: no frame can have such
};

/// What a drawing needs beside the sums. All must outlive it.
struct DrawingParts {
  const Gl& gl;
  const SurfelStore& store;
  std::array<SurfelWays, kSurfelKinds.size()> ways;  ///< by SurfelKind::index()
  const SurfelClip* clip;                            ///< null: nothing is clipped
  const Program& shading;
  const VertexArray& nothing;  ///< for the pass over the whole image
  const RenderSettings settings;
};

/// Draws surfels into one frame:
/// 1. visibility: the depth of all discs, set back along the ray (section 3.2);
/// 2. accumulation: what is not behind that adds its attributes, or, sorted, is laid over what is
///    there;
/// 3. shading: the sums are normalised and shaded, where pass 1 covers the image.
class Drawing final : public GlDrawing {
 public:
  Drawing(DrawingParts parts, SplatSums sums);

  void draw(const GlFrame& frame, PassTimer& timer) const override;

 private:
  void draw_pass(const DrawnSurfels& drawn, const Program SurfelPrograms::*program) const;
  void accumulate(const GlFrame& frame, const DrawnSurfels& drawn) const;
  void shade(const GlFrame& frame) const;

  DrawingParts parts_;
  SplatSums sums_;
};

}  // namespace relief::surfel
