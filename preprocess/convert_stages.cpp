#include "preprocess/convert_stages.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace relief {

Status check_spacing(double spacing, double area, std::uint64_t points) {
  // Grids beyond this many nodes per point come from a mistaken spacing, not from a scan.
  constexpr double max_nodes_per_point = 4096.0;
  constexpr double max_nodes = 4e9;
  const double nodes = area / (spacing * spacing);
  if (nodes > std::min(max_nodes, max_nodes_per_point * static_cast<double>(points))) {
    return make_error(
        "a spacing of {} would give about {:.1e} samples for {} points; choose a larger --spacing",
        spacing, nodes, points);
  }
  return {};
}

Status check_spacing(double spacing, const Bounds& scan) {
  const double diagonal = glm::distance(scan.min, scan.max);
  if (spacing <= diagonal) return {};
  return make_error(
      "a spacing of {:.6g} is more than the scan is wide, {:.6g}; choose a smaller --spacing",
      spacing, diagonal);
}

ResampleOptions resample_options(const ConvertOptions& options, bool seams, double spacing,
                                 NormalSource normals) {
  return {.spacing = spacing,
          .height_step = options.height_step,
          .steps_per_spacing = options.steps_per_spacing,
          .overlap_cells = seams ? 1 : options.overlap_cells,
          .colour_scale = static_cast<std::uint32_t>(options.colour_scale),
          .normals = normals,
          .seams = seams};
}

NormalSource source_of_normals(bool are_given, bool is_moved) {
  if (are_given) return NormalSource::Points;
  return is_moved ? NormalSource::FitsAndPoints : NormalSource::Fits;
}

void count_texels(const std::vector<Patch>& patches, ConvertReport& report) {
  for (const Patch& patch : patches) {
    report.colour_texels += patch.colours.texels.size();
    if (!patch.colours.empty())
      report.texels_per_cell = std::max(report.texels_per_cell, patch.colours.scale);
    report.normal_texels += patch.normals.texels.size();
    report.normal_texels_per_cell = std::max(report.normal_texels_per_cell, patch.normals.scale);
  }
}

}  // namespace relief
