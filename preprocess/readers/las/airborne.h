// Recognises airborne scans.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// Returns whether points look as if they were scanned from above, by an aircraft. `sample`: points
/// evenly picked from the scan, world frame. `several_returns`: some pulses had several echoes.
///
/// Files do not tell. An aircraft sees the ground evenly; a scanner that stands on it, or is
/// carried over it, has most points near itself, and walls stand over one cell of a map. So a scan
/// is airborne if, without the outermost hundredth along each axis, it is at least three times as
/// wide as high, if cells of a map have few points more than usual, and if few points share a cell
/// with others far above or below, which trees do only with several echoes.
[[nodiscard]] bool looks_airborne(const std::vector<glm::dvec3>& sample, bool several_returns);

}  // namespace relief
