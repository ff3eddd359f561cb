// The line between two looks, which can be dragged.
#pragma once

#include "viewer/window/events.h"

namespace relief {

/// How near to the line it can be grabbed, in pixels of a screen whose content scale is 1.
inline constexpr double kGrabPixels = 6.0;

/// Where the divider is and what the mouse does with it.
struct Divider {
  double share = 0.5;  ///< of the picture's width, 0 to 1
  bool is_held = false;
  bool is_hovered = false;
  double grip = 0.0;  ///< from the line to the cursor that holds it, pixels
};

/// Moves the divider of a picture that is `width` pixels wide. `free`: the cursor is over the
/// picture and no button is held for something else. Returns whether the event was the divider's,
/// and so is nobody else's.
bool react_to(const Event& event, double width, double scale, bool free, Divider& divider);

}  // namespace relief
