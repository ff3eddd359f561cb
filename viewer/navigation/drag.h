// What drags with the cursor do to a camera.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "viewer/navigation/limits.h"
#include "viewer/navigation/pose.h"
#include "viewer/navigation/turn.h"

namespace relief {

enum class DragKind : std::uint8_t {
  Orbit,  ///< turns about the point under the cursor
  Pan,    ///< moves across the view: the point under the cursor stays under it
  Zoom,   ///< up: nearer to the point under the cursor at the drag's beginning
  Roll,   ///< turns the image about its middle
  Look    ///< turns the head; an orthographic camera orbits
};

/// What a drag depends on but its cursor.
struct DragSettings {
  glm::dvec2 size{1.0};  ///< of the image, pixels
  OrbitStyle style = OrbitStyle::Turntable;
  glm::dvec3 axis{0.0, 1.0, 0.0};  ///< the turntable's, of length 1
  Limits limits;
};

/// A drag under way. Each pose but a roll's follows from where the drag began, so that rounding
/// does not add up, and a cursor that comes back brings the camera back.
struct Drag {
  DragKind kind = DragKind::Orbit;
  Pose from;
  glm::dvec2 start{0.0};  ///< cursor
  glm::dvec2 last{0.0};   ///< cursor
  glm::dvec3 point{0.0};  ///< before the eye, from the poses' origin
  double angle = 0.0;     ///< that the image has been rolled by, radians
};

/// Moves the cursor of a drag and returns the pose.
[[nodiscard]] Pose dragged(Drag& drag, glm::dvec2 cursor, const DragSettings& settings);

}  // namespace relief
