// The engine `onepass` (paper 001): every sample is a splat, or every four a cell, every fragment
// finds its attributes on the patch, and one pass is all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/draw_list.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/patch_store.h"
#include "renderer/sample_draws.h"
#include "renderer/view.h"

namespace relief::onepass {

/// Draws a stored model. The model, its store and `gl` must outlive the engine.
class Engine {
 public:
  /// `features` from features.h.
  static Result<Engine> create(const Gl& gl, const PatchStore& store, std::uint32_t features);

  /// Draws one frame into the bound framebuffer, whose depth was cleared to 0; the frame uniforms
  /// must be bound. `environment` is needed by the material mirror.
  void draw(const View& view, PassTimer& timer, const Texture* environment) const;

 private:
  /// What draws.
  struct Programs {
    Program main;
    std::optional<Program> large_sprites;  ///< with sprites
    std::optional<Program> rims;           ///< with cells: their border splats
    std::optional<Program> edges;          ///< with cells: those of levels that holes touch
  };

  Engine(const Gl& gl, const PatchStore& store, Programs programs);
  void draw_splats(const View& view) const;
  void draw_cells(const View& view) const;
  void draw_strips(const CellPage& page, const std::vector<ArraysCommand>& commands) const;

  const Gl* gl_;
  SampleDraws samples_;
  Programs programs_;
};

}  // namespace relief::onepass
