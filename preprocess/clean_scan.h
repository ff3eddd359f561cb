// Takes noise and stray points out of a scan, before a surface is made of it.
#pragma once

#include <optional>
#include <vector>

#include "common/error.h"
#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"

namespace relief {

/// What cleaning found out that the conversion needs.
struct CleanScan {
  /// The positions as scanned, if noise was removed; empty otherwise.
  std::vector<glm::dvec3> scanned;
  /// Unit, sign arbitrary, 0 for points without noise; empty if no noise was removed.
  std::vector<glm::vec3> normals;
  /// Of the points as they are now; nothing if it was not needed.
  std::optional<NeighbourGraph> graph;
};

/// Drops stray points (find_stray_points) of bare points, and reports them. If there are any, the
/// others are sorted anew (sort_in_space). Fails if the user interrupts.
Result<CleanScan> drop_strays(Points& points, const ConvertOptions& options, ConvertReport& report,
                              Progress& progress);

/// Moves points to where they are without noise (remove_noise), as options.noise has it, and
/// reports it. By default the vertices of meshes stay as they are: a mesh is its triangles. `unit`:
/// what lengths are in, in world units, for messages. `clean`: of drop_strays, whose graph is still
/// the points'. Fails if the user interrupts.
Status drop_noise(Points& points, const ConvertOptions& options, double unit, CleanScan& clean,
                  ConvertReport& report, Progress& progress);

}  // namespace relief
