// What drags with the cursor do to a camera.
#pragma once

#include <cstdint>

namespace relief {

enum class DragKind : std::uint8_t {
  Orbit,  ///< turns about the point under the cursor
  Pan,    ///< moves across the view: the point under the cursor stays under it
  Zoom,   ///< up: nearer to the point under the cursor at the drag's beginning
  Roll,   ///< turns the image about its middle
  Look    ///< turns the head; an orthographic camera orbits
};

/// Turntable: to the side about the model's up axis, up and down about the image's horizontal; the
/// image is never upside down. Trackball: about the image's own axes.
enum class OrbitStyle : std::uint8_t { Turntable, Trackball };

}  // namespace relief
