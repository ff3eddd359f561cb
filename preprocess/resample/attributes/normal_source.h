// What the normals of a patch's samples come from.
#pragma once

#include <cstdint>

namespace relief {

enum class NormalSource : std::uint8_t {
  Fits,    ///< the fitted surface
  Points,  ///< the points' normals: the file gives them
  /// The fitted surface where the points' normals agree with it, else these: they were found over
  /// wide supports, and know the sides of a crease, which the fit blunts.
  FitsAndPoints
};

}  // namespace relief
