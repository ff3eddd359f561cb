#include "common/seams/cube_runs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relief {
namespace {

std::uint64_t key_of(const Cube& cube) {
  constexpr std::uint64_t mask = (1U << 21U) - 1;
  return ((static_cast<std::uint64_t>(cube.x) & mask) << 42U) |
         ((static_cast<std::uint64_t>(cube.y) & mask) << 21U) |
         (static_cast<std::uint64_t>(cube.z) & mask);
}

}  // namespace

CubeRuns::CubeRuns(std::span<const glm::dvec3> positions, double side) : side_(side) {
  if (positions.empty()) return;
  origin_ = positions.front();
  std::vector<std::uint64_t> keys;
  keys.reserve(positions.size());
  for (const glm::dvec3& p : positions) keys.push_back(key_of(cube_of(p)));
  order_.resize(positions.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::stable_sort(order_.begin(), order_.end(),
                   [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  runs_.reserve(positions.size());
  for (std::uint32_t k = 0; k < order_.size(); ++k)
    ++runs_.try_emplace(keys[order_[k]], Run{k, 0}).first->second.count;
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

std::span<const std::uint32_t> CubeRuns::in(const Cube& cube) const {
  const auto found = runs_.find(key_of(cube));
  if (found == runs_.end()) return {};
  return std::span(order_).subspan(found->second.first, found->second.count);
}

}  // namespace relief
