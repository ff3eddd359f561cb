// Chooses irregular but evenly spread points on a surface, for the splats of a textured mesh.
#pragma once

#include <cstddef>

#include "preprocess/texture/acquisition/surface_points.h"

namespace relief {

/// Keeps `count` of the candidates (at least as many), evenly: removes the candidate with the most
/// crowded neighbourhood until `count` are left (Yuksel 2015, "Sample elimination for generating
/// Poisson disk sample sets", with its weight (1 - d / 2 r_max)^8). Sheets that face away from each
/// other do not count as crowded. `area` of the surface, world units squared. Keeps the order of
/// the candidates. The result does not depend on the number of threads.
[[nodiscard]] SurfacePoints thin_out(const SurfacePoints& candidates, std::size_t count,
                                     double area);

}  // namespace relief
