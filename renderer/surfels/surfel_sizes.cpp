#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "renderer/surfels/cell_sizes.h"
#include "renderer/surfels/distinct_positions.h"
#include "renderer/surfels/neighbour_sizes.h"
#include "renderer/surfels/surfels.h"
#include "renderer/surfels/triangle_clusters.h"

namespace relief {
namespace {

/// Sizes of distinct positions, and the cluster of each.
struct DistinctSizes {
  std::vector<double> diameters;
  std::vector<std::uint32_t> clusters;
  std::size_t triangles = 0;
  std::size_t leftovers = 0;
};

Result<DistinctSizes> find_bsp_sizes(const std::vector<glm::dvec3>& positions, SurfelSize method,
                                     Progress& progress) {
  RELIEF_TRY_ASSIGN(const PointClusters clusters, find_triangle_clusters(positions, progress));
  DistinctSizes sizes;
  sizes.diameters.resize(positions.size());
  sizes.clusters.resize(positions.size());
  std::vector<std::uint32_t> leftovers;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const std::span<const std::uint32_t> points = clusters.of(c);
    for (const std::uint32_t k : points) sizes.clusters[k] = static_cast<std::uint32_t>(c);
    if (points.size() == 3) {
      const SurfelTriangle triangle(positions[points[0]], positions[points[1]],
                                    positions[points[2]]);
      if (!triangle.is_collinear()) {
        ++sizes.triangles;
        for (const std::uint32_t k : points) sizes.diameters[k] = diameter_of(triangle, method);
        continue;
      }
    }
    leftovers.insert(leftovers.end(), points.begin(), points.end());
  }
  sizes.leftovers = leftovers.size();
  RELIEF_TRY(give_leftover_sizes(positions, leftovers, method, sizes.diameters, progress));
  return sizes;
}

/// The normal of each distinct position: of the last point there.
std::vector<glm::vec3> of_distinct(std::span<const glm::vec3> normals,
                                   const DistinctPositions& distinct) {
  std::vector<glm::vec3> picked(normals.empty() ? 0 : distinct.positions.size());
  for (std::size_t k = 0; k < normals.size(); ++k) {
    if (distinct.of[k] != DistinctPositions::kNone) picked[distinct.of[k]] = normals[k];
  }
  return picked;
}

}  // namespace

// Duplicates have the size of the one position that they share; points that are not finite have 1.
Result<SurfelSizes> find_surfel_sizes(std::span<const glm::dvec3> positions,
                                      std::span<const glm::vec3> normals, SurfelSize method,
                                      Progress& progress) {
  const DistinctPositions distinct = find_distinct_positions(positions);
  DistinctSizes found;
  if (method == SurfelSize::Qsplat) {
    RELIEF_TRY_ASSIGN(found.diameters, find_qsplat_sizes(distinct.positions, progress));
  } else if (method == SurfelSize::Cell) {
    const std::vector<glm::vec3> distinct_normals = of_distinct(normals, distinct);
    RELIEF_TRY_ASSIGN(found.diameters,
                      find_cell_sizes(distinct.positions, distinct_normals, progress));
  } else {
    RELIEF_TRY_ASSIGN(found, find_bsp_sizes(distinct.positions, method, progress));
  }
  SurfelSizes sizes;
  sizes.diameters.assign(positions.size(), 1.0);
  if (!found.clusters.empty()) sizes.clusters.assign(positions.size(), DistinctPositions::kNone);
  sizes.triangles = found.triangles;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const std::uint32_t of = distinct.of[k];
    if (of == DistinctPositions::kNone) continue;
    // Squares of the smallest distances vanish, and twice the largest ones overflow.
    using Limits = std::numeric_limits<double>;
    sizes.diameters[k] =
        std::clamp(found.diameters[of] * distinct.unit, Limits::min(), Limits::max());
    if (!found.clusters.empty()) sizes.clusters[k] = found.clusters[of];
  }
  sizes.leftovers = found.leftovers;
  return sizes;
}

// Leaves at most 0.001 % of the known surfaces bare (docs/decisions/0128), rounded up to a tenth.
double closing_scale(SurfelSize method) {
  switch (method) {
    case SurfelSize::BspEdge:
      return 4.5;
    case SurfelSize::BspCircle:
      return 3.1;
    case SurfelSize::Qsplat:
      return 2.1;
    case SurfelSize::Cell:
      return 1.1;
    case SurfelSize::Given:
      break;
  }
  return 1.0;
}

}  // namespace relief
