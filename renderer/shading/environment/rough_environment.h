// What a rough mirror reflects.
#pragma once

#include <cstdint>

#include "renderer/shading/environment/cube_map.h"

namespace relief {

/// Texels along a face's side that the lobe of a roughness needs: at least two in the half of its
/// width at half its height, if the environment itself has them, but no more than 512.
[[nodiscard]] std::uint32_t rough_size(const CubeMap& environment, double roughness);

/// The light that a mirror of microfacets (GGX, alpha = roughness^2; Walter et al. 2007, Eq. 33)
/// sends back along a direction which it faces, for each direction: the mean over all directions l,
/// weighted with D(h) (n . l) where h is the half vector (Karis 2013, "Real Shading in Unreal
/// Engine 4", where view, normal and reflection are one). Looked up along a smooth mirror's
/// reflection it is this project's definition of a rough one, in every engine.
///
/// Sums over a fixed set of directions, each looked up in a copy of the environment as coarse as
/// the directions are sparse there (Colbert and Krivanek 2007): the same for any number of threads.
/// `roughness` in (0, 1]. `size`: texels along a face's side of the result.
[[nodiscard]] CubeMap prefilter(const CubeMap& environment, double roughness, std::uint32_t size);

}  // namespace relief
