// Rasters whose cells are not square, with square ones.
#pragma once

#include <memory>

#include "preprocess/raster/raster.h"

namespace relief {

/// Returns a raster of square cells with the smaller of the two sides of `cell`: rows, or columns,
/// are interpolated where there were fewer. A cubic through four heights (Catmull-Rom), a line
/// through two beside holes; no height is made where one of the two nearest is missing. `cell`: the
/// sides of a cell in the world, which differ.
std::unique_ptr<HeightRaster> make_even(std::unique_ptr<HeightRaster> raster, glm::dvec2 cell);

}  // namespace relief
