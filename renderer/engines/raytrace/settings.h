// What can be chosen about the engine `raytrace`.
#pragma once

namespace relief {

struct RaytraceSettings {
  int samples = 16;  ///< rays per pixel, in a fixed pattern; 1: through the pixel's middle
};

}  // namespace relief
