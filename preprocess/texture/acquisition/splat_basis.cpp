#include "preprocess/texture/acquisition/splat_basis.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "common/neighbours/radius_search.h"

namespace relief {
namespace {

// A position within the support in the tangent plane may lie off that plane; where the surface
// bends so much that this is not enough, normals differ too much for the plane to be a
// parameterisation.
constexpr double kSearchReach = 1.1;

struct Entry {
  std::uint32_t splat = 0;
  double value = 0.0;
};

using Row = std::vector<Entry>;

Row evaluate_row(const SurfacePoints& splats, const SplatBasis& basis, const RadiusSearch& search,
                 glm::dvec3 position, glm::vec3 normal, std::vector<std::uint32_t>& found) {
  const double variance = basis.deviation * basis.deviation;
  search.find(position, kSearchReach * std::sqrt(2.0 * basis.cutoff * variance), found);
  Row row;
  double sum = 0.0;
  for (const std::uint32_t k : found) {
    if (glm::dot(normal, splats.normals[k]) <= 0.0F) continue;
    const glm::dvec3 offset = position - splats.positions[k];
    const double height = glm::dot(offset, glm::dvec3(splats.normals[k]));
    const double exponent = (glm::dot(offset, offset) - height * height) / (2.0 * variance);
    if (exponent >= basis.cutoff) continue;
    row.push_back({k, std::exp(-exponent)});
    sum += row.back().value;
  }
  const double scale = basis.kind == BasisKind::Normalised
                           ? 1.0 / sum
                           : 0.5 / (std::numbers::pi * (1.0 - std::exp(-basis.cutoff)));
  for (Entry& entry : row) entry.value *= scale;
  return row;
}

}  // namespace

Eigen::SparseMatrix<double, Eigen::RowMajor> evaluate_basis(const SurfacePoints& splats,
                                                            const SplatBasis& basis,
                                                            const SurfacePoints& positions) {
  assert(basis.deviation > 0.0 && basis.cutoff > 0.0);
  const RadiusSearch search(splats.positions);
  std::vector<Row> rows(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 1024),
                    [&](const auto& range) {
                      std::vector<std::uint32_t> found;
                      for (std::size_t q = range.begin(); q != range.end(); ++q) {
                        rows[q] = evaluate_row(splats, basis, search, positions.positions[q],
                                               positions.normals[q], found);
                      }
                    });
  std::size_t entries = 0;
  for (const Row& row : rows) entries += row.size();
  assert(entries < std::numeric_limits<int>::max() && "callers bound the number of entries");
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(static_cast<Eigen::Index>(positions.size()),
                                                      static_cast<Eigen::Index>(splats.size()));
  matrix.reserve(static_cast<Eigen::Index>(entries));
  for (std::size_t q = 0; q < rows.size(); ++q) {
    matrix.startVec(static_cast<Eigen::Index>(q));
    for (const Entry& entry : rows[q]) {
      matrix.insertBack(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(entry.splat)) =
          entry.value;
    }
  }
  matrix.finalize();
  return matrix;
}

}  // namespace relief
