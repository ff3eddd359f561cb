#include "preprocess/partition/move_borders.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "preprocess/partition/borders.h"
#include "preprocess/partition/region_cells.h"

namespace relief {
namespace {

// A border moves by a point's distance in each sweep. After ten, 113 points of the Dragon still
// wait and 19,701 have moved; the limit also ends pairs that swap forever.
constexpr int kMaxSweeps = 10;
// The cost of a point's slope is limited to that at 87 degrees.
constexpr float kMinCosine = 0.05F;
// Smaller gains may be rounding errors.
constexpr double kMinGain = 1e-9;

/// The regions around a point, and the share of its neighbourhood in each.
class Surrounding {
 public:
  void add(std::uint32_t region, double weight) {
    std::size_t position = 0;
    while (position < count_ && parts_[position].region != region) ++position;
    if (position == count_) parts_[count_++] = {region, 0.0};
    parts_[position].weight += weight;
  }

  struct Part {
    std::uint32_t region;
    double weight;
  };
  [[nodiscard]] auto begin() const { return parts_.begin(); }
  [[nodiscard]] auto end() const { return parts_.begin() + static_cast<std::ptrdiff_t>(count_); }

 private:
  std::array<Part, kBorderNeighbours> parts_;
  std::size_t count_ = 0;
};

class BorderMover {
 public:
  BorderMover(const SurfaceSamples& samples, const NeighbourGraph& graph, double cone_degrees,
              const BorderWeights& weights, const std::vector<Region>& regions)
      : samples_(samples),
        graph_(graph),
        near_(std::min(kBorderNeighbours, graph.k)),
        cos_cone_(static_cast<float>(std::cos(glm::radians(cone_degrees)))),
        weights_(weights),
        cells_(samples, regions),
        waits_(cells_.size(), 0),
        moved_in_(cells_.size(), -1) {}

  void run() {
    std::vector<std::uint32_t> work = border_points();
    std::vector<std::uint32_t> next;
    for (int sweep = 0; sweep < kMaxSweeps && !work.empty(); ++sweep) {
      for (const std::uint32_t i : work) waits_[i] = 0;
      const std::vector<std::uint32_t> best = best_regions(work);
      for (std::size_t k = 0; k < work.size(); ++k) {
        const std::uint32_t i = work[k];
        const bool is_moved_beside =
            std::ranges::any_of(near(i), [&](std::uint32_t j) { return moved_in_[j] == sweep; });
        const std::uint32_t to = is_moved_beside ? best_region(i) : best[k];
        if (to == cells_.owner(i)) continue;
        cells_.move(i, to);
        moved_in_[i] = static_cast<std::int8_t>(sweep);
        for (const std::uint32_t j : near(i)) {
          if (waits_[j] != 0 || cells_.owner(j) == RegionCells::kNone) continue;
          waits_[j] = 1;
          next.push_back(j);
        }
      }
      work.swap(next);
      next.clear();
    }
  }

  /// Sets the regions' points to the current assignment.
  void store(std::vector<Region>& regions) const {
    for (Region& region : regions) region.points.clear();
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (cells_.owner(i) != RegionCells::kNone) regions[cells_.owner(i)].points.push_back(i);
    }
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> near(std::uint32_t point) const {
    return graph_.of(point).first(near_);
  }

  [[nodiscard]] std::vector<std::uint32_t> border_points() {
    const auto points = static_cast<std::uint32_t>(cells_.size());
    tbb::parallel_for(std::uint32_t{0}, points, [&](std::uint32_t i) {
      if (cells_.owner(i) == RegionCells::kNone) return;
      waits_[i] = std::ranges::any_of(near(i), [&](std::uint32_t j) {
        return cells_.owner(j) != cells_.owner(i) && cells_.owner(j) != RegionCells::kNone;
      });
    });
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < points; ++i) {
      if (waits_[i] != 0) found.push_back(i);
    }
    return found;
  }

  /// The best regions of some points before any of them moves.
  [[nodiscard]] std::vector<std::uint32_t> best_regions(
      const std::vector<std::uint32_t>& points) const {
    std::vector<std::uint32_t> best(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t k) { best[k] = best_region(points[k]); });
    return best;
  }

  [[nodiscard]] float cosine(std::uint32_t point, std::uint32_t region) const {
    return glm::dot(samples_.normals[point], cells_.normal(region));
  }

  /// The cost of a point in a region that holds `weight` of its neighbourhood.
  [[nodiscard]] double cost(std::uint32_t point, std::uint32_t region, double weight) const {
    const double stretch = 1.0 / std::max(cosine(point, region), kMinCosine);
    return weights_.stretch * kBorderNeighbours * stretch - weight;
  }

  [[nodiscard]] std::uint32_t best_region(std::uint32_t point) const {
    const std::uint32_t own = cells_.owner(point);
    Surrounding around;
    around.add(own, 0.0);
    for (const std::uint32_t j : near(point)) {
      const std::uint32_t region = cells_.owner(j);
      if (region == RegionCells::kNone || !on_one_sheet(samples_, point, j)) continue;
      const double turn = 1.0 - double{glm::dot(samples_.normals[point], samples_.normals[j])};
      around.add(region, 1.0 / (1.0 + weights_.crease * turn));
    }
    std::uint32_t best = own;
    double lowest = cost(point, own, around.begin()->weight) - kMinGain;
    for (const auto& [region, weight] : around) {
      if (region == own || cosine(point, region) < cos_cone_) continue;
      const double here = cost(point, region, weight);
      if (here >= lowest || !cells_.is_on_its_sheet(point, region)) continue;
      best = region;
      lowest = here;
    }
    return best;
  }

  SurfaceSamples samples_;
  const NeighbourGraph& graph_;
  std::uint32_t near_;
  float cos_cone_;
  BorderWeights weights_;
  RegionCells cells_;
  std::vector<std::uint8_t> waits_;    // for the next sweep
  std::vector<std::int8_t> moved_in_;  // the last sweep that has moved a point; -1: none has
};

}  // namespace

void move_borders(const SurfaceSamples& samples, const NeighbourGraph& graph, double cone_degrees,
                  const BorderWeights& weights, std::vector<Region>& regions) {
  BorderMover mover(samples, graph, cone_degrees, weights, regions);
  mover.run();
  mover.store(regions);
  std::erase_if(regions, [](const Region& region) { return region.points.empty(); });
  tbb::enumerable_thread_specific<RegionTest> tests(
      [&] { return RegionTest(samples, {cone_degrees}); });
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    // A region may pass only with its old normal, because cells then begin elsewhere.
    if (const auto normal = tests.local().fit(regions[r].points)) regions[r].normal = *normal;
  });
}

}  // namespace relief
