// Makes the cells of patches.
#pragma once

#include "common/patch.h"
#include "renderer/geometry/cells/cell_parts.h"
#include "renderer/geometry/cells/levels.h"
#include "renderer/geometry/samples/samples.h"

namespace relief {

/// Makes the cells of a patch. `samples` are its own.
///
/// A cell is drawn if all four samples are valid and no edge rises by more than kSteepest cells:
/// what mesh_of_patches.h makes for the ray tracer, halved along the same diagonal. (A fixed one:
/// corrected interpolation, which the splats follow, has it too, so that images of all
/// three agree, and a run needs no bit a cell to say which.) A cell with holes at its corners has
/// what PatchBorder gives of it.
[[nodiscard]] PatchCells make_cells(const Patch& patch, const PatchSamples& samples);

/// Makes those of a patch that ends where others begin: its whole cells (cell_triangles), as
/// strips, without splats; Seams have the rest.
[[nodiscard]] PatchCells make_joined_cells(const Patch& patch);

/// Makes those of a coarser level. It has splats only beside jumps: its cells reach beyond the
/// patch and its mask, and are cut off there.
[[nodiscard]] PatchCells make_cells(const PatchLevel& level, const PatchSamples& samples);

}  // namespace relief
