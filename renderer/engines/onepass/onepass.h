// The engine `onepass` (paper 001): every sample is a splat, or every four a cell, every fragment
// finds its attributes on the patch, and one pass is all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/draw_list.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/layers.h"
#include "renderer/engines/onepass/visibility.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/gl_picture.h"
#include "renderer/patch_store.h"
#include "renderer/sample_draws.h"
#include "renderer/view.h"

namespace relief::onepass {

/// Draws a stored model. The model, its store and `gl` must outlive the engine.
class Engine {
 public:
  /// `features` from features.h.
  static Result<Engine> create(const Gl& gl, const PatchStore& store, std::uint32_t features);

  /// Draws one frame of a picture that was cleared; the frame uniforms must be bound. `visibility`:
  /// made for this picture, where the features ask for it.
  void draw(const GlPicture& picture, const Visibility* visibility, const MaterialChoice& materials,
            PassTimer& timer) const;

  /// Draws semi-transparent patches over a picture whose opaque ones and backdrop are drawn, by
  /// depth peeling: the surface nearest to the eye, then the nearest behind it, and so on.
  void draw_over(const GlPicture& picture, const Layers& layers, const MaterialChoice& materials,
                 PassTimer& timer) const;

 private:
  /// What draws.
  struct Programs {
    Program main;
    std::optional<Program> large_sprites = std::nullopt;  ///< with sprites
    std::optional<Program> rims = std::nullopt;           ///< with cells: their border splats
    std::optional<Program> edges = std::nullopt;   ///< with cells: those of levels that holes touch
    std::optional<Program> behind = std::nullopt;  ///< of layers: shading all but the first
    std::optional<Program> over = std::nullopt;    ///< of layers: puts them over the picture
    std::optional<Program> shading = std::nullopt;  ///< where cells only find what is seen
  };

  static Result<Programs> make_cell_programs(const Gl& gl, const PatchStore& store,
                                             std::uint32_t features);
  Engine(const Gl& gl, const PatchStore& store, Programs programs);
  void draw_model(const View& view, const MaterialChoice& materials) const;
  void draw_splats(const View& view) const;
  void draw_cells(const View& view, const MaterialChoice& materials) const;
  void draw_strips(const CellPage& page, const std::vector<ArraysCommand>& commands) const;
  void shade(const Program& shading, const Visibility& visibility,
             const Texture& visible_depth) const;
  [[nodiscard]] bool draw_layer(const GlPicture& picture, const Layer& layer, const Layer& before,
                                const MaterialChoice& materials, PassTimer& timer) const;

  const Gl* gl_;
  SampleDraws samples_;
  Programs programs_;
};

}  // namespace relief::onepass
