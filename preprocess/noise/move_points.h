// Moves points onto the surface that the windows around them describe.
#pragma once

#include <vector>

#include "preprocess/noise/windows.h"

namespace relief {

/// Points without their noise.
struct SmoothPoints {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, sign arbitrary; 0 for points that did not move
};

/// Moves each window's centre to the mean of where the windows that hold it have the surface, and
/// takes the mean of their normals. A window counts by how sure it is there, and by how likely the
/// centre is its surface's: so that windows beyond a crease, which a centre's own window must not
/// reach over, count little, and those that end at it give the surface up to it ([Xu and Foi 2021]
/// combine windows likewise).
///
/// `noise`: standard deviation of the centres, world units. Centres without noise stay, and those
/// far off all windows.
[[nodiscard]] SmoothPoints move_points(const std::vector<NoiseWindow>& windows,
                                       const std::vector<float>& noise, Progress& progress);

}  // namespace relief
