#include "common/seams/make_seams.h"

#include <tbb/parallel_for.h>

#include "common/seams/border_mesh.h"
#include "common/seams/border_parts.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/seam_vertices.h"
#include "common/seams/stitching/stitch.h"

namespace relief {
namespace {

/// The triangles of the cells that are not whole.
void add_partial_cells(const Patch& patch, const CellTriangles& cells,
                       std::vector<Triangle>& triangles) {
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      if (cells.at(i, j) == kWholeCell) continue;
      for_each_triangle(patch, cells, i, j,
                        [&](const Triangle& corners) { triangles.push_back(corners); });
    }
  }
}

}  // namespace

Seams make_seams(std::span<const Patch> patches, bool is_closed) {
  Seams seams;
  seams.triangles.resize(patches.size());
  const std::vector<CellTriangles> cells = cell_triangles(patches);
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    add_partial_cells(patches[p], cells[p], seams.triangles[p]);
  });
  BorderMesh borders = find_borders(patches, cells);
  find_planes(patches, borders);
  find_parts(patches, cells, borders);
  share_out(stitch(borders, is_closed), borders, seams);
  return seams;
}

}  // namespace relief
