// A shader variant of the engine `onepass` [Ochotta 2008]: every sample is a splat, or every four
// a cell, every fragment finds its attributes on the patch, and one pass is all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/engines/onepass/cell_draws.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/programs.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/gl/functions.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/draw_list.h"
#include "renderer/view/view.h"

namespace relief::onepass {

/// The programs of some features, and the model that they draw. The model, its store and `gl` must
/// outlive it.
struct Variant {
  /// `features` from features.h.
  static Result<Variant> create(const Gl& gl, const PatchStore& store, Features features);

  const Gl* gl;
  SampleDraws samples;
  Programs programs;
};

/// What a frame draws of the opaque or of the semi-transparent patches.
struct DrawBatch {
  std::optional<CellDraws> cells;
  std::optional<SampleDraw> splats;      ///< without cells: quads or sprites
  std::optional<SampleDraw> large;       ///< of sprites that are too large for OpenGL
  std::vector<ElementsCommand> proxies;  ///< of models seen from afar
};

/// Chooses the patches of those materials that the view shows, and relates them to its camera.
[[nodiscard]] DrawBatch make_batch(const Variant& variant, const View& view,
                                   const MaterialChoice& materials);

/// As make_batch does with cells, also of views from behind.
[[nodiscard]] DrawBatch make_cell_batch(const Variant& variant, const View& view,
                                        const MaterialChoice& materials,
                                        SeenFrom seen = SeenFrom::Anywhere);

}  // namespace relief::onepass
