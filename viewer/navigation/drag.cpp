#include "viewer/navigation/drag.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "viewer/navigation/move.h"

namespace relief {
namespace {

/// An orbit across the image's smaller side is half a turn.
constexpr double kOrbitPerSide = glm::pi<double>();

/// A zoom across the image's height is this many steps: ten times as large.
constexpr double kZoomPerHeight = 12.6;

Pose orbit_of(const Drag& drag, glm::dvec2 shift, const DragSettings& settings) {
  const double angle = kOrbitPerSide / std::min(settings.size.x, settings.size.y);
  const Pose pose = orbited(drag.from, drag.point, shift, angle, settings.style, settings.axis);
  return kept_before_model(settings.limits, drag.from, pose);
}

/// The scene follows the cursor: a pixel is as large an angle as one in the image's middle.
Pose look_of(const Drag& drag, glm::dvec2 shift, const DragSettings& settings) {
  const double angle = image_height_at(drag.from, 1.0) / settings.size.y;
  return orbited(drag.from, drag.from.eye, -shift, angle, settings.style, settings.axis);
}

Pose pan_of(const Drag& drag, glm::dvec2 shift, const DragSettings& settings) {
  const double depth = depth_of(drag.from, drag.point);
  const Pose pose = panned(drag.from, shift, depth, settings.size.y);
  return within_reach(settings.limits, drag.from,
                      kept_before_model(settings.limits, drag.from, pose));
}

}  // namespace

Pose dragged(Drag& drag, glm::dvec2 cursor, const DragSettings& settings) {
  if (drag.kind == DragKind::Roll)
    drag.angle += angle_about_middle(drag.last, cursor, settings.size);
  drag.last = cursor;
  const glm::dvec2 shift = cursor - drag.start;
  switch (drag.kind) {
    case DragKind::Orbit:
      return orbit_of(drag, shift, settings);
    case DragKind::Pan:
      return pan_of(drag, shift, settings);
    case DragKind::Zoom:
      return zoomed(drag.from, -kZoomPerHeight * shift.y / settings.size.y, drag.point,
                    settings.limits);
    case DragKind::Roll:
      return rolled(drag.from, drag.angle);
    case DragKind::Look:
      return drag.from.is_orthographic() ? orbit_of(drag, shift, settings)
                                         : look_of(drag, shift, settings);
  }
  return drag.from;
}

}  // namespace relief
