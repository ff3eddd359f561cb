// What of a kernel lies before an opaque surface.
#pragma once

#include <glm/vec2.hpp>

#include "renderer/volume/splats/footprint.h"

namespace relief {

/// The share of a kernel, 0 to 1, that a pixel's ray meets before a depth along the view axis
/// (world units). `from_centre`: the pixel from the footprint's centre. The kernel's depths at a
/// pixel are a Gaussian, so that the share is its distribution function; of a kernel without
/// thickness all lies where its mean depth does. Before an infinite depth lies all, before a
/// negative infinite one nothing.
[[nodiscard]] double share_before(const Footprint& footprint, glm::dvec2 from_centre, double depth);

/// What is left of a contribution with that share: of an optical depth (KernelWeight::Integral) the
/// share of it, of an opacity (Peak) the opacity of the share of its optical depth.
[[nodiscard]] double weight_before(double weight, double share, KernelWeight kind);

}  // namespace relief
