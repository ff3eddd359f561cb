// An irregular but even choice of points on a surface: the splats of a textured mesh.
#pragma once

#include <cstddef>

#include "preprocess/texture/acquisition/surface_points.h"

namespace relief {

/// Keeps `count` of the candidates (at least as many), evenly: the candidate with the most crowded
/// neighbourhood goes first, until `count` are left (Yuksel 2015, "Sample elimination for
/// generating Poisson disk sample sets", with its weight (1 - d / 2 r_max)^8). Sheets that face
/// away from each other do not crowd each other. `area`: that of the surface, world units squared.
/// The order of the candidates is kept. Does not depend on the number of threads.
[[nodiscard]] SurfacePoints thin_out(const SurfacePoints& candidates, std::size_t count,
                                     double area);

}  // namespace relief
