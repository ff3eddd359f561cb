// The engine `onepass` (paper 001): every sample is a splat, or every four a cell, every fragment
// finds its attributes on the patch, and one pass is all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/engines/onepass/back.h"
#include "renderer/engines/onepass/cell_draws.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/layers.h"
#include "renderer/engines/onepass/programs.h"
#include "renderer/engines/onepass/visibility.h"
#include "renderer/frame/gl_image.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/draw_list.h"
#include "renderer/view/view.h"

namespace relief::onepass {

/// Draws a stored model. The model, its store and `gl` must outlive the engine.
class Engine {
 public:
  /// `features` from features.h.
  static Result<Engine> create(const Gl& gl, const PatchStore& store, std::uint32_t features);

  /// Draws one frame of a picture that was cleared; the frame uniforms must be bound. `visibility`:
  /// made for this picture, where the features ask for it, and `back` likewise.
  void draw(const GlPicture& picture, const Visibility* visibility, const Back* back,
            const MaterialChoice& materials, PassTimer& timer) const;

  /// Draws semi-transparent patches over a picture whose opaque ones and backdrop are drawn, by
  /// depth peeling: the surface nearest to the eye, then the nearest behind it, and so on.
  void draw_over(const GlPicture& picture, const Layers& layers, const MaterialChoice& materials,
                 PassTimer& timer) const;

 private:
  /// What a frame draws of the opaque or of the semi-transparent patches.
  struct Frame {
    std::optional<CellDraws> cells;
    std::optional<SampleDraw> splats;         ///< without cells: quads or sprites
    std::optional<SampleDraw> large;          ///< of sprites that are too large for OpenGL
    std::vector<ElementsCommand> far_models;  ///< of models seen from afar
  };

  Engine(const Gl& gl, const PatchStore& store, Programs programs);
  [[nodiscard]] Frame make_frame(const View& view, const MaterialChoice& materials) const;
  [[nodiscard]] Frame make_cell_frame(const View& view, const MaterialChoice& materials) const;
  [[nodiscard]] Frame make_splat_frame(const View& view) const;
  void draw_patches(const Frame& frame) const;
  void draw_back(const GlPicture& picture, const Back& back, PassTimer& timer) const;
  void draw_far_models(const Frame& frame, PassTimer& timer) const;
  void shade(const Program& shading, const Visibility& visibility,
             const Texture& visible_depth) const;
  [[nodiscard]] bool draw_layer(const GlPicture& picture, const Frame& frame, const Layer& layer,
                                const Layer& before, PassTimer& timer) const;

  const Gl* gl_;
  SampleDraws samples_;
  Programs programs_;
};

}  // namespace relief::onepass
