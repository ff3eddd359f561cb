// Sample records: what the vertex stage reads of a patch, sixteen bytes a sample.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/samples/splat_reach.h"

namespace relief {

/// One sample, packed as shaders/include/shared.h says. It holds all that the vertex stage needs,
/// which thus reads no map: llvmpipe runs it on one thread.
struct SampleRecord {
  std::uint32_t node = 0;   ///< column, row, border flag
  std::uint32_t shape = 0;  ///< height index, slopes
  std::uint32_t reach = 0;  ///< toward -x, +x, -y, +y: a byte each, in steps of kReachStep
  std::uint32_t gap = 0;    ///< there, in steps of kGapStep
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

/// Makes the records of a patch: splat_slopes.h says how the splats lean, splat_reach.h how far
/// they extend. Border samples, those with a hole or the patch's edge among their eight neighbours,
/// are flagged.
/// `to_hole`: as find_reaches has it.
[[nodiscard]] PatchSamples make_samples(const Patch& patch, float to_hole = kReachToHole);

/// The radius (cells) about a sample that no parallelogram of its splat exceeds in any view.
/// `slope`: of its plane, height per cell.
[[nodiscard]] double covering_radius(const SampleRecord& record, glm::dvec2 slope);

/// The same without records, where no splat is drawn.
[[nodiscard]] PatchSamples bound_samples(const Patch& patch);

}  // namespace relief
