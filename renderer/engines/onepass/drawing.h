// The passes of the engine `onepass` over opaque surfaces.
#pragma once

#include <optional>

#include "renderer/engines/onepass/back.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/variant.h"
#include "renderer/engines/onepass/visibility.h"
#include "renderer/frame/gl_frame.h"

namespace relief::onepass {

/// What a frame is drawn into beside its targets; none where its features ask for none.
struct Buffers {
  std::optional<Visibility> visibility = {};
  std::optional<Back> back = {};
};

/// Draws a model into one frame:
/// 1. back: the far side of glass with two interfaces, if there is any;
/// 2. visibility and shading: the cells find the surface, and a pass over the image shades it; or
///    onepass: everything shades its own fragments, where that is cheaper;
/// 3. proxies: those seen small enough, as meshes.
class Drawing final : public GlDrawing {
 public:
  /// `variant` must outlive it; `buffers` were made for the frame and the variant's features.
  Drawing(const Variant& variant, Buffers buffers, MaterialChoice materials);

  void draw(const GlFrame& frame, PassTimer& timer) const override;

 private:
  void draw_back(const GlFrame& frame, PassTimer& timer) const;

  const Variant& variant_;
  Buffers buffers_;
  MaterialChoice materials_;
};

/// Shades what was found, each pixel once. `visible_depth`: what was tested when it was found. The
/// model is bound (BoundModel), and so is the framebuffer to shade into.
void shade_found(const Gl& gl, const Program& shading, const Visibility& visibility,
                 const Texture& visible_depth);

}  // namespace relief::onepass
