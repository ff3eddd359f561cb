#include <tbb/task_group.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <mutex>

#include "preprocess/partition/partition.h"

namespace relief {
namespace {

// The direction of greatest variance of a point set, and its centroid.
struct Principal {
  glm::dvec3 centroid;
  glm::dvec3 axis;
};

Principal principal_axis(const std::vector<glm::dvec3>& positions,
                         std::span<const std::uint32_t> points) {
  const glm::dvec3 base = positions[points.front()];
  glm::dvec3 sum(0.0);
  for (const std::uint32_t i : points) sum += positions[i] - base;
  const glm::dvec3 mean = sum / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : points) {
    const glm::dvec3 d = positions[i] - base - mean;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    covariance.noalias() += v * v.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  return {base + mean, glm::dvec3(axis.x(), axis.y(), axis.z())};
}

// Sets of this size and above are split in their own task.
constexpr std::size_t kTaskPoints = 8192;

class Splitter {
 public:
  Splitter(const SurfaceSamples& samples, const RegionLimits& limits, Progress& progress)
      : samples_(samples), limits_(limits), progress_(progress) {}

  std::vector<Region> run(std::span<std::uint32_t> points) {
    RegionTest test(samples_, limits_);
    if (!points.empty()) split(points, test);
    tasks_.wait();
    return std::move(leaves_);
  }

 private:
  void split(std::span<std::uint32_t> points, RegionTest& test) {
    if (progress_.cancelled()) return;
    if (points.size() < 2) return keep(points, samples_.normals[points.front()]);
    if (const auto normal = test.fit(points)) return keep(points, *normal);
    const Principal principal = principal_axis(samples_.positions, points);
    const auto middle = std::partition(points.begin(), points.end(), [&](std::uint32_t i) {
      const glm::dvec3 d = samples_.positions[i] - principal.centroid;
      return d.x * principal.axis.x + d.y * principal.axis.y + d.z * principal.axis.z < 0.0;
    });
    auto left = static_cast<std::size_t>(middle - points.begin());
    // Rounding can leave one side empty when the points all but coincide.
    if (left == 0 || left == points.size()) left = points.size() / 2;
    const std::span<std::uint32_t> halves[2] = {points.first(left), points.subspan(left)};
    for (const std::span<std::uint32_t> half : halves) {
      if (half.size() < kTaskPoints) {
        split(half, test);
      } else {
        tasks_.run([this, half] {
          RegionTest own_test(samples_, limits_);
          split(half, own_test);
        });
      }
    }
  }

  void keep(std::span<const std::uint32_t> points, glm::vec3 normal) {
    Region region{{points.begin(), points.end()}, normal};
    std::sort(region.points.begin(), region.points.end());
    const std::lock_guard lock(mutex_);
    leaves_.push_back(std::move(region));
    progress_.advance(points.size());
  }

  SurfaceSamples samples_;
  RegionLimits limits_;
  Progress& progress_;
  tbb::task_group tasks_;
  std::mutex mutex_;
  std::vector<Region> leaves_;
};

}  // namespace

std::vector<Region> split(const SurfaceSamples& samples, const NeighbourGraph& graph,
                          std::vector<std::uint32_t> points, const RegionLimits& limits,
                          Progress& progress) {
  std::vector<Region> leaves = Splitter(samples, limits, progress).run(points);
  // Tasks finish in any order; the result must not depend on it.
  std::sort(leaves.begin(), leaves.end(),
            [](const Region& a, const Region& b) { return a.points.front() < b.points.front(); });
  return part_components(samples, graph, leaves);
}

}  // namespace relief
