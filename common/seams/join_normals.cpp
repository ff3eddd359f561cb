#include "common/seams/join_normals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "common/mesh/creases.h"
#include "common/octahedral.h"
#include "common/seams/border_mesh.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/vertex_grid.h"

namespace relief {
namespace {

// Samples within this many spacings of a hole tell its normal.
constexpr double kReachInSpacings = 1.5;
// Shading turns over a crease if no more than this share of its angle is left between the samples.
constexpr double kShadedOver = 0.85;

struct Neighbourhood {
  glm::dvec3 position{0.0};  ///< world: where the patch's surface would be
  glm::dvec3 normal{0.0};    ///< world, not unit: the sum of the samples' beside it
  int samples = 0;
};

/// What the samples beside a hole say of it.
Neighbourhood continue_to(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  Neighbourhood around;
  double height = 0.0;
  for (std::uint32_t y = j > 0 ? j - 1 : 0; y <= std::min(j + 1, patch.height - 1); ++y) {
    for (std::uint32_t x = i > 0 ? i - 1 : 0; x <= std::min(i + 1, patch.width - 1); ++x) {
      if (patch.at(x, y) == kHole) continue;
      const glm::dvec3 n(unit_from_snorm16(patch.normals.texels[std::size_t{y} * patch.width + x]));
      const glm::dvec2 step(static_cast<double>(i) - x, static_cast<double>(j) - y);
      height += patch.at(x, y) * patch.height_step -
                patch.spacing * glm::dot(step, glm::dvec2(n)) / std::max(n.z, 0.2);
      around.normal += n;
      ++around.samples;
    }
  }
  if (around.samples == 0) return around;
  around.position = patch.origin + patch.axes * glm::dvec3(i * patch.spacing, j * patch.spacing,
                                                           height / around.samples);
  around.normal = patch.axes * around.normal;
  return around;
}

/// Whether shading turns over a crease, as it does where a mesh has one normal a vertex: the
/// normals beside it turn toward each other, so that less is left between them than between the
/// planes.
bool is_shaded_over(glm::dvec3 normal, glm::dvec3 plane, const BorderVertex& other) {
  const auto angle = [](glm::dvec3 a, glm::dvec3 b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
  };
  return angle(normal, other.normal) < kShadedOver * angle(plane, other.plane_normal);
}

/// What border vertices about a hole say of its normal.
class Surroundings {
 public:
  /// `own`: the normal that the patch's own samples tell; `weight`: theirs.
  Surroundings(std::uint32_t patch, glm::dvec3 own, double weight)
      : patch_(patch), own_(own), sum_(own * weight) {}

  void add(const BorderVertex& vertex, double weight) {
    if (vertex.patch == patch_) {
      plane_ += weight * vertex.plane_normal;
    } else if (glm::dot(vertex.normal, own_) >= kCreaseCosine) {
      sum_ += weight * vertex.normal;
    } else {
      turned_.emplace_back(&vertex, weight);
    }
  }

  [[nodiscard]] glm::dvec3 normal() const {
    glm::dvec3 sum = sum_;
    const double length = glm::length(plane_);
    for (const auto& [vertex, weight] : turned_) {
      if (length > 0.0 && is_shaded_over(own_, plane_ / length, *vertex))
        sum += weight * vertex->normal;
    }
    // Opposed normals cancel out to rounding.
    return glm::length(sum) > 1e-6 ? glm::normalize(sum) : own_;
  }

 private:
  std::uint32_t patch_;
  glm::dvec3 own_;
  glm::dvec3 sum_;
  glm::dvec3 plane_{0.0};
  std::vector<std::pair<const BorderVertex*, double>> turned_;  ///< others' beyond a crease
};

void join_patch(std::uint32_t id, const BorderMesh& borders, const VertexGrid& lookup,
                Patch& patch) {
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) != kHole) continue;
      const Neighbourhood beside = continue_to(patch, i, j);
      if (beside.samples == 0) continue;
      const double reach = kReachInSpacings * patch.spacing;
      // Weighted by distance, the own samples at about one spacing.
      const auto weight = [reach](double squared) {
        const double w = 1.0 - squared / (reach * reach);
        return w * w;
      };
      Surroundings around(id, glm::normalize(beside.normal), weight(patch.spacing * patch.spacing));
      lookup.for_each_within(beside.position, reach,
                             [&](const VertexGrid::Place& place, double squared) {
                               around.add(borders.vertices[place.vertex], weight(squared));
                             });
      const glm::vec3 local(glm::transpose(patch.axes) * around.normal());
      patch.normals.texels[std::size_t{j} * patch.width + i] = snorm16_from_unit(local);
    }
  }
}

}  // namespace

void join_normals(PatchModel& model) {
  for (const PatchRun& run : model.joined) {
    const std::span<Patch> patches = std::span(model.patches).subspan(run.first, run.count);
    BorderMesh borders = find_borders(patches, cell_triangles(std::span<const Patch>(patches)));
    find_planes(patches, borders);
    const VertexGrid lookup(borders.vertices);
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
      if (patches[p].normals.scale == 1 && !patches[p].normals.empty())
        join_patch(static_cast<std::uint32_t>(p), borders, lookup, patches[p]);
    });
  }
}

}  // namespace relief
