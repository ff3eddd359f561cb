// The passes of the engine `onepass` where some surfaces are semi-transparent.
#pragma once

#include "renderer/engines/onepass/drawing.h"
#include "renderer/engines/onepass/layers.h"

namespace relief::onepass {

/// Draws the opaque patches as Drawing does and, over them and the backdrop, the others by depth
/// peeling: the surface nearest to the eye, then the nearest behind it, and so on. Does not count
/// fragments.
class LayeredDrawing final : public GlDrawing {
 public:
  struct Parts {
    const Variant& opaque;
    const Variant& layered;  ///< of the same features and RELIEF_FEATURE_LAYERED
    Buffers buffers;
    Layers layers;
    MaterialChoice opaque_materials;
    MaterialChoice transparent_materials;
  };

  explicit LayeredDrawing(Parts parts);

  void draw(const GlFrame& frame, PassTimer& timer) const override;
  void draw_over(const GlFrame& frame, PassTimer& timer) const override;

 private:
  [[nodiscard]] bool find_layer(const GlFrame& frame, const DrawBatch& batch, std::size_t layer,
                                PassTimer& timer) const;

  Drawing opaque_;
  const Variant& layered_;
  Layers layers_;
  MaterialChoice materials_;
};

}  // namespace relief::onepass
