#include "common/seams/cube_runs.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

std::uint64_t row_key(std::int64_t y, std::int64_t z) {
  return (static_cast<std::uint64_t>(z) << 32U) | static_cast<std::uint32_t>(y);
}

/// A position in the order of rows and their cubes.
struct Placed {
  std::uint64_t row = 0;
  std::int64_t x = 0;
  std::uint32_t index = 0;

  [[nodiscard]] bool operator<(const Placed& b) const {
    if (row != b.row) return row < b.row;
    return x != b.x ? x < b.x : index < b.index;
  }
};

}  // namespace

CubeRuns::CubeRuns(std::span<const glm::dvec3> positions, double side) : side_(side) {
  if (positions.empty()) return;
  origin_ = positions.front();
  std::vector<Placed> placed;
  placed.reserve(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const Cube at = cube_of(positions[i]);
    placed.push_back({row_key(at.y, at.z), at.x, i});
  }
  tbb::parallel_sort(placed.begin(), placed.end());
  order_.reserve(placed.size());
  const Placed* last = nullptr;
  for (const Placed& p : placed) {
    const auto cube = static_cast<std::uint32_t>(cubes_.size());
    const bool new_row = last == nullptr || last->row != p.row;
    if (new_row) {
      rows_.insert(p.row, static_cast<std::uint32_t>(row_firsts_.size()));
      row_firsts_.push_back(cube);
    }
    if (new_row || last->x != p.x)
      cubes_.push_back({p.x, static_cast<std::uint32_t>(order_.size())});
    order_.push_back(p.index);
    last = &p;
  }
  row_firsts_.push_back(static_cast<std::uint32_t>(cubes_.size()));
  cubes_.push_back({0, static_cast<std::uint32_t>(order_.size())});
}

Cube CubeRuns::cube_of(glm::dvec3 position) const {
  // Beyond this, doubles no longer tell neighbouring cubes apart.
  static constexpr double kFarthest = 4.5e15;
  const auto whole = [](double x) {
    if (!(x > -kFarthest)) return static_cast<std::int64_t>(-kFarthest);
    return static_cast<std::int64_t>(std::floor(std::min(x, kFarthest)));
  };
  const glm::dvec3 at = (position - origin_) / side_;
  return {whole(at.x), whole(at.y), whole(at.z)};
}

CubeRuns::Run CubeRuns::in_row(std::int64_t low_x, std::int64_t high_x, std::int64_t y,
                               std::int64_t z) const {
  const std::uint32_t row = rows_.find(row_key(y, z));
  if (row == FlatMap::kNone) return {};
  const auto begin = cubes_.begin() + row_firsts_[row];
  const auto end = cubes_.begin() + row_firsts_[row + 1];
  const auto first = std::lower_bound(
      begin, end, low_x, [](const Filled& cube, std::int64_t x) { return cube.x < x; });
  auto last = first;
  while (last != end && last->x <= high_x) ++last;
  return {first->first, last->first - first->first};
}

}  // namespace relief
