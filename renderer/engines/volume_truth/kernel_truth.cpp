#include "renderer/engines/volume_truth/kernel_truth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief::volume_truth {
namespace {

/// Rays that are swept at once: 60 MB of them.
constexpr std::size_t kBatch = 1U << 18U;
/// Rays that are one piece of work.
constexpr std::size_t kRaysOfPiece = 512;

/// Between two planes a ray has at most so many parts in which its colour is taken as linear in the
/// optical depth. In noise that is opaque within a node, and steps of half a standard deviation,
/// one part is off by 1e-3, eight by 1e-4.
constexpr int kMostParts = 8;

/// What a ray has met in a plane.
struct Met {
  double depth = 0.0;  ///< along the view axis
  Density density;
};

/// Four planes' cubic: the density at a share of the way from the second to the third.
Density cubic_at(const std::array<Met, 4>& planes, double share) {
  const double u = share;
  const std::array<double, 4> weights{
      -u * (u - 1.0) * (u - 2.0) / 6.0, (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0,
      -(u + 1.0) * u * (u - 2.0) / 2.0, (u + 1.0) * u * (u - 1.0) / 6.0};
  Density at;
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t c = 0; c < 4; ++c) at.values[c] += weights[p] * planes[p].density.values[c];
  }
  return at;
}

/// A ray on its way through the planes.
struct Sweep {
  glm::dvec3 start{0.0};    ///< the grid's coordinates, at depth 0
  glm::dvec3 along{0.0};    ///< for a unit of depth
  double length = 1.0;      ///< world units for a unit of depth
  std::size_t ray = 0;      ///< of the image
  int met = 0;              ///< planes
  std::array<Met, 4> last;  ///< the latest ones, in the order in which they were met
  RaySum sum;

  /// Takes the next plane's: puts what is between the two before it behind what has been gathered.
  void meet(const Met& next) {
    last = {last[1], last[2], last[3], next};
    ++met;
    const auto& [a, b, c, d] = last;
    if (met < 4 || !(b.density.extinction() > 0.0 || c.density.extinction() > 0.0)) return;
    const double rough =
        0.5 * (b.density.extinction() + c.density.extinction()) * (c.depth - b.depth) * length;
    const double seen = sum.transmittance * std::min(rough, 1.0);
    const int parts =
        std::clamp(static_cast<int>(std::ceil(12.0 * std::sqrt(seen))), 1, kMostParts);
    Met low = b;
    for (int p = 0; p < parts; ++p) {
      const double share = (p + 1.0) / parts;
      const Met high =
          p + 1 == parts ? c : Met{b.depth + share * (c.depth - b.depth), cubic_at(last, share)};
      put(low, cubic_at(last, (p + 0.5) / parts), high);
      low = high;
    }
  }

  /// Puts a part behind it, by Simpson's rule, which is exact for cubics. Where kernels begin,
  /// cubics swing below 0; parts that do count, so that all together are exact.
  void put(const Met& from, const Density& middle, const Met& to) {
    const double mean =
        (from.density.extinction() + 4.0 * middle.extinction() + to.density.extinction()) / 6.0;
    const bool has_first = from.density.extinction() > 0.0;
    const bool has_last = to.density.extinction() > 0.0;
    if (!has_first && !has_last) return;
    add(sum, {.from = from.depth,
              .to = to.depth,
              .optical_depth = mean * (to.depth - from.depth) * length,
              .first = (has_first ? from : to).density.colour(),
              .last = (has_last ? to : from).density.colour()});
  }
};

/// The sums in a plane across one axis, at the nodes of the other two.
class Plane {
 public:
  Plane(const NodeKernels& kernels, int axis)
      : kernels_(kernels),
        axis_(axis),
        columns_(kernels.size()[(axis + 1) % 3]),
        rows_(kernels.size()[(axis + 2) % 3]),
        sums_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
        used_(static_cast<std::size_t>(rows_), Used{}) {}

  void move_to(double at) {
    tbb::parallel_for(0, rows_, [&](int row) {
      const std::span line = std::span(sums_).subspan(
          static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_),
          static_cast<std::size_t>(columns_));
      std::fill(line.begin(), line.end(), Density{});
      kernels_.sum_across(axis_, at, row, line);
      Used used{columns_, -1};
      for (int c = 0; c < columns_; ++c) {
        if (!(line[static_cast<std::size_t>(c)].extinction() > 0.0)) continue;
        used.first = std::min(used.first, c);
        used.last = c;
      }
      used_[static_cast<std::size_t>(row)] = used;
    });
  }

  /// The kernels' sum at a place of the plane (the grid's coordinates).
  [[nodiscard]] Density sum_at(glm::dvec3 place) const {
    Density sum;
    const double x = place[(axis_ + 1) % 3];
    const double y = place[(axis_ + 2) % 3];
    const double reach = kernels_.reach();
    if (!(x > -reach && y > -reach && x < columns_ + reach && y < rows_ + reach)) return sum;
    const Reached across(x, reach);
    const Reached up(y, reach);
    const double scale = 0.5 / (kernels_.sigma() * kernels_.sigma());
    for (int row = std::max(up.first, 0); row <= std::min(up.last, rows_ - 1); ++row) {
      const Used& used = used_[static_cast<std::size_t>(row)];
      const int first = std::max(across.first, used.first);
      const int last = std::min(across.last, used.last);
      if (first > last) continue;
      const double dy = row - y;
      // exp(-scale * d^2) along the row by multiplication: its logarithm is a parabola.
      const double dx = first - x;
      double weight = std::exp(-scale * (dx * dx + dy * dy));
      double ratio = std::exp(-scale * (2.0 * dx + 1.0));
      const double bend = std::exp(-2.0 * scale);
      const Density* density =
          &sums_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(first)];
      for (int n = first; n <= last; ++n, ++density) {
        for (std::size_t c = 0; c < 4; ++c) sum.values[c] += weight * density->values[c];
        weight *= ratio;
        ratio *= bend;
      }
    }
    return sum;
  }

 private:
  /// The columns of a row where there is anything.
  struct Used {
    int first = 0;
    int last = -1;
  };

  const NodeKernels& kernels_;
  int axis_;
  int columns_;
  int rows_;
  std::vector<Density> sums_;
  std::vector<Used> used_;
};

/// Moves rays through the planes across one axis, upwards or downwards.
class Sweeper {
 public:
  Sweeper(const NodeKernels& kernels, int axis, bool is_upward, double step)
      : kernels_(kernels),
        axis_(axis),
        is_upward_(is_upward),
        step_(step * kernels.sigma()),
        plane_(kernels, axis) {}

  void run(std::span<Sweep> rays, Progress& progress) {
    const double extent = kernels_.size()[axis_] - 1 + 2.0 * kernels_.reach();
    const auto planes = static_cast<int>(std::ceil(extent / step_)) + 1;
    // Two more, for what lies between the last ones.
    for (int p = 0; p < planes + 2; ++p) {
      if (progress.cancelled()) return;
      const double up = -kernels_.reach() + step_ * (is_upward_ ? p : planes - 1 - p);
      plane_.move_to(up);
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), kRaysOfPiece),
                        [&](const auto& range) {
                          for (std::size_t r = range.begin(); r < range.end(); ++r)
                            pass(rays[r], up);
                        });
      const auto of_all = static_cast<std::size_t>(planes) + 2;
      const auto plane = static_cast<std::size_t>(p);
      progress.advance(rays.size() * (plane + 1) / of_all - rays.size() * plane / of_all);
    }
  }

 private:
  void pass(Sweep& ray, double at) const {
    if (ray.sum.is_done()) return;
    const double depth = (at - ray.start[axis_]) / ray.along[axis_];
    if (depth < 0.0) return;
    const Met met{depth, plane_.sum_at(place_of(ray, depth))};
    if (ray.met == 0) begin(ray, met);
    ray.meet(met);
  }

  static glm::dvec3 place_of(const Sweep& ray, double depth) {
    return ray.start + depth * ray.along;
  }
  [[nodiscard]] Met met_at(const Sweep& ray, double depth) const {
    return {depth, kernels_.sum_at(place_of(ray, depth))};
  }

  /// Puts the part from the ray's start to the first plane into the sum, which an eye within the
  /// volume sees, and meets the plane before the start.
  void begin(Sweep& ray, const Met& first) const {
    const double between = step_ / std::abs(ray.along[axis_]);
    if (first.depth > between) {  // the ray starts before all planes
      ray.meet({first.depth - between, {}});
      return;
    }
    const Met start = met_at(ray, 0.0);
    const Met middle = met_at(ray, 0.5 * first.depth);
    ray.put(start, middle.density, first);
    ray.meet(met_at(ray, first.depth - between));
  }

  const NodeKernels& kernels_;
  int axis_;
  bool is_upward_;
  double step_;  ///< of planes, spacings
  Plane plane_;
};

/// The axis that a ray crosses the fastest, and which way: 2 * axis + 1 upwards.
int way_of(glm::dvec3 along) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::abs(along[a]) > std::abs(along[axis])) axis = a;
  }
  return 2 * axis + (along[axis] > 0.0 ? 1 : 0);
}

}  // namespace

void integrate_kernels(const NodeKernels& kernels, const RegularGrid& grid, const View& view,
                       double step, SampleImage& into, Progress& progress) {
  const glm::dmat3 to_grid = glm::inverse(grid.step);
  progress.begin_stage("integrating kernels", into.rays.size());
  for (std::size_t first = 0; first < into.rays.size(); first += kBatch) {
    const std::size_t end = std::min(first + kBatch, into.rays.size());
    std::array<std::vector<Sweep>, 6> ways;
    for (std::size_t r = first; r < end; ++r) {
      const auto at = static_cast<std::int64_t>(r);
      const glm::dvec2 window = into.window(at % into.width, at / into.width);
      const glm::dvec3 through = ray_through(view, window);
      Sweep ray;
      ray.start = to_grid * (view.eye + ray_start(view, window) - grid.origin);
      ray.along = to_grid * through;
      ray.length = glm::length(through);
      ray.ray = r;
      ways[static_cast<std::size_t>(way_of(ray.along))].push_back(ray);
    }
    for (std::size_t way = 0; way < ways.size(); ++way) {
      if (ways[way].empty()) continue;
      Sweeper(kernels, static_cast<int>(way / 2), way % 2 == 1, step).run(ways[way], progress);
      if (progress.cancelled()) return;
      for (const Sweep& ray : ways[way]) into.rays[ray.ray] = ray.sum;
    }
  }
}

}  // namespace relief::volume_truth
