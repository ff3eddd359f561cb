// Sample records: what the vertex stage reads of a patch, eight bytes a sample.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"

namespace relief {

/// One sample, packed as shaders/include/shared.h says. It holds all that the vertex stage needs,
/// which thus reads no map: llvmpipe runs it on one thread.
struct SampleRecord {
  std::uint32_t place = 0;  ///< column, row, width class, border flag
  std::uint32_t shape = 0;  ///< height index, slopes
};

/// The samples of a patch, row by row, and what holds for all of them.
struct PatchSamples {
  std::vector<SampleRecord> records;
  float height_step = 0.0F;  ///< cells per height index
  float slope_step = 0.0F;   ///< height in cells per cell, per slope step
  glm::dvec3 centre{0.0};    ///< of a sphere about all splats, in the grid frame (cells)
  double radius = 0.0;       ///< of that sphere, cells
  double widest_disc = 0.0;  ///< radius that no disc or parallelogram exceeds, cells
};

/// Makes the records of a patch.
///
/// A splat's plane has the slope of the heights (central differences), not that of the normal map:
/// the planes must meet, whatever is painted on them. Only border samples take the normal map's,
/// which is smoother than a one-sided difference.
///
/// The width class says how far the splat reaches beyond its own cell. At the middle of an edge or
/// corner that it shares with its neighbours their planes part by some height g; a view ray that
/// rises by an angle of at least a over the surface can't pass between two planes that both reach
/// m >= g / (2 tan a) beyond it. The class is the least with such an m for a = 30 degrees, but no
/// more than half a cell within the plane: larger margins close no more holes on curved or noisy
/// fields, and stick out of crests and silhouettes (measured: docs/decisions.md).
///
/// Border samples, those with a hole or the patch's edge among their eight neighbours, are flagged.
/// Their splats reach that far anyway, over the notches between the ragged borders of two patches.
[[nodiscard]] PatchSamples make_samples(const Patch& patch);

}  // namespace relief
