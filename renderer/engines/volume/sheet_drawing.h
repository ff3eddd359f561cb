// Draws a regular grid from prefiltered sheets: each node is shaded once, kernels are widened to
// their footprints sheet by sheet, and a pixel reads a sheet once where its ray meets it.
#pragma once

#include <memory>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether OpenGL shades these settings' nodes, so that the frame needs no colours.
[[nodiscard]] bool shades_nodes(const RenderSettings& settings);

class SheetDrawing : public VolumeDrawing {
 public:
  /// Whether it draws a frame of which is_for_grid() is true: no outputs beside the colour, and
  /// kernels that are neither narrower nor wider than what can be prefiltered.
  [[nodiscard]] virtual bool is_for(const VolumeFrame& frame) const = 0;
};

/// `volume`: a regular grid.
[[nodiscard]] std::unique_ptr<SheetDrawing> make_sheet_drawing(const Gl& gl,
                                                               const ScalarVolume& volume);

}  // namespace relief::volume
