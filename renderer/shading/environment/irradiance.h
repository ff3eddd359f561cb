// What surfaces scatter of their surroundings.
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "renderer/shading/environment/cube_map.h"

namespace relief {

/// The nine coefficients of shared::Frame::irradiance: the light that a white surface scatters
/// under the environment, as spherical harmonics of its normal up to the second order, which hold
/// all but 1 % of it (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
/// Environment Maps"). w is 0.
[[nodiscard]] std::array<glm::vec4, 9> irradiance_of(const CubeMap& environment);

}  // namespace relief
