// Shading of the surfaces that splatting leaves in the pixels ([Zwicker 2001], section 4).
#pragma once

#include "renderer/engines/ewa/layered_buffer.h"
#include "renderer/shading/shading.h"
#include "renderer/view/view.h"

namespace relief::ewa {

/// The colour that a surface shows at a position in the image (pixels from the upper left corner,
/// the middle of a pixel). Where normals cancelled out, it faces the eye. A mirror's reflection is
/// averaged over the pixel, in which the normal turns toward its neighbours', by up to 4 x 4
/// lookups: a single one would alias however well the normals are filtered.
[[nodiscard]] glm::dvec3 shade_surface(const Surface& surface, glm::dvec2 position,
                                       const View& view, const Lighting& lighting);

}  // namespace relief::ewa
