#include "preprocess/add_distances.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/neighbours/position_tree.h"
#include "common/scalars/quantise.h"

namespace relief {
namespace {

double distance_to(const PositionTree& tree, glm::dvec3 from) {
  double nearest = std::numeric_limits<double>::max();
  std::array<double, PositionTree::kLeafSize> squared{};
  tree.visit_near(
      from, [&nearest] { return nearest; },
      [&](std::size_t first, std::size_t count) {
        tree.squared_distances(from, first, squared);
        for (std::size_t m = 0; m < count; ++m) nearest = std::min(nearest, squared[m]);
      });
  return std::sqrt(nearest);
}

/// The distance at every node; NaN over holes.
std::vector<double> distances_of(const Patch& patch, const PositionTree& tree) {
  std::vector<double> distances(patch.heights.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      distances[std::size_t{j} * patch.width + i] = distance_to(tree, position_of(patch, i, j));
    }
  }
  return distances;
}

}  // namespace

Status add_distances(const std::vector<glm::dvec3>& positions, PatchModel& model,
                     Progress& progress) {
  if (model.scalars.size() == kMaxScalars)
    return make_error("with {} there are more than {} scalars", kDistanceScalar, kMaxScalars);
  progress.begin_stage("distances", model.patches.size());
  const PositionTree tree(positions);
  std::vector<std::vector<double>> distances(model.patches.size());
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    distances[p] = distances_of(model.patches[p], tree);
    progress.advance(1);
  });
  if (progress.cancelled()) return interrupted_error();
  PointScalar all{kDistanceScalar, false, {}};
  for (const auto& some : distances) all.values.insert(all.values.end(), some.begin(), some.end());
  const auto info = describe_scalar(all);
  if (!info) return make_error("there are no samples whose distance could be measured");
  for (std::size_t p = 0; p < distances.size(); ++p) {
    Patch& patch = model.patches[p];
    AttributeMap<std::uint16_t> map{patch.width, patch.height, 1, {}};
    map.texels.reserve(distances[p].size());
    for (const double distance : distances[p]) map.texels.push_back(code_of(*info, distance));
    patch.scalars.push_back(std::move(map));
  }
  model.scalars.push_back(*info);
  return {};
}

}  // namespace relief
