// Windows: discs of points that one quadric describes but for noise.
#pragma once

#include <vector>

#include "common/neighbours/position_tree.h"
#include "common/progress.h"
#include "preprocess/noise/quadric_fit.h"

namespace relief {

/// The largest disc about a centre over which a scan bends like a quadric.
struct NoiseWindow {
  glm::dvec3 centre{0.0};       ///< world frame
  double unit = 0.0;            ///< length of the quadric's units, world units; 0: no noise there
  Quadric quadric{};            ///< about the centre
  double squared_radius = 0.0;  ///< units; 0: points about the centre are no disc
  double points = 0.0;          ///< number of points in the disc
  double stands_for = 1.0;      ///< number of centres that share it

  [[nodiscard]] bool exists() const { return squared_radius > 0.0; }
};

/// Finds the window about each centre. A disc grows while the quadric leaves over no more than the
/// noise, and while the heights that it and all smaller discs give the centre agree, each within
/// its own uncertainty (intersection of confidence intervals, [Goldenshluger and Nemirovski 1997]).
///
/// Neighbouring centres share one, 2 to 16 of them, where windows are large.
///
/// `spacing`: the scan's about each centre, `noise`: its standard deviation there, world units; a
/// centre without noise has no window, nor have centres of balls of points. Only some have one if
/// the user interrupts. The result does not depend on the number of threads.
[[nodiscard]] std::vector<NoiseWindow> find_windows(const PositionTree& tree,
                                                    const std::vector<glm::dvec3>& centres,
                                                    const std::vector<float>& spacing,
                                                    const std::vector<float>& noise,
                                                    Progress& progress);

}  // namespace relief
