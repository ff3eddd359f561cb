// Eye-dome lighting: shading from depth alone, which needs neither normals nor lights.
#pragma once

#include "common/image/image.h"
#include "common/scene/camera.h"

namespace relief {

/// Darkens pixels behind whose neighbours they lie, by how much: depth that steps back becomes a
/// dark line, a slope a shade (Boucheny 2009, "Visualisation scientifique de grands volumes de
/// données", chapter 3: exp(-strength * mean of the eight neighbours' steps of log2 of the depth),
/// with the factor that Potree and CloudCompare have). Neighbours are a 700th of the image's height
/// away, so that a larger image is shaded alike. Multiplies R, G and B, by the channel Z; the
/// background stays. `camera`: the image's. Does not depend on the number of threads.
void shade_eye_dome(Image& image, const Camera& camera, double strength);

/// Returns what that measures steps of an orthographic camera's depth in: log2 of a depth has as
/// large steps as this times the depth (world units). 0 for a perspective camera.
[[nodiscard]] double eye_dome_scale(const Camera& camera);

}  // namespace relief
