// Draws a regular grid sheet by sheet: one pass over the image, each pixel gathers the kernels
// around its ray, front to back, until nothing is seen through them.
#pragma once

#include <memory>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether GridDrawing draws this frame as volume-reference does: a regular grid in sheets, no
/// surface beside it, all rays through the sheets at an angle that is not too small.
[[nodiscard]] bool is_for_grid(const Gl& gl, const VolumeFrame& frame, const ScalarVolume* volume);

class GridDrawing : public VolumeDrawing {
 public:
  /// Whether it lights the nodes of a frame with these settings, which then needs no colours.
  [[nodiscard]] virtual bool lights_nodes(const RenderSettings& settings) = 0;
};

/// `volume`: a regular grid.
[[nodiscard]] std::unique_ptr<GridDrawing> make_grid_drawing(const Gl& gl,
                                                             const ScalarVolume& volume);

}  // namespace relief::volume
