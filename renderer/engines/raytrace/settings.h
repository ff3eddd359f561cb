// What can be chosen about the engine `raytrace`.
#pragma once

namespace relief {

/// With one sample a pixel shows what its middle shows, as the pixels of `onepass` do. With more,
/// colour and coverage are means over the pixel (box filter), while normal, depth, UV and patch id
/// are still those of its middle, because means of them say nothing where a surface ends: a pixel
/// at a silhouette can have some coverage and nothing in these outputs, or the reverse.
struct RaytraceSettings {
  int samples = 16;  ///< rays per pixel, at least 1; see sample_pattern for where they are
};

}  // namespace relief
