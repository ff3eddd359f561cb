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

/// What a ray has met in a plane.
struct Met {
  double depth = 0.0;  ///< along the view axis
  double extinction = 0.0;
  glm::dvec3 colour{0.0};

  Met() = default;
  Met(double at, const Density& density) : depth(at), extinction(density.extinction()) {
    if (extinction > 0.0) colour = density.colour();
  }
};

/// A ray on its way through the planes.
struct Sweep {
  glm::dvec3 start{0.0};    ///< the grid's coordinates, at depth 0
  glm::dvec3 along{0.0};    ///< for a unit of depth
  double length = 1.0;      ///< world units for a unit of depth
  std::size_t ray = 0;      ///< of the image
  int met = 0;              ///< planes
  std::array<Met, 3> last;  ///< the latest ones, in the order in which they were met
  RaySum sum;

  /// Takes the next plane's: puts what is between the two before it behind what has been gathered.
  void meet(const Met& next) {
    const auto& [a, b, c] = last;
    if (met >= 3 && (b.extinction > 0.0 || c.extinction > 0.0)) {
      const double mean =
          (13.0 * (b.extinction + c.extinction) - a.extinction - next.extinction) / 24.0;
      put(b, c, std::max(mean, 0.0));
    }
    last = {b, c, next};
    ++met;
  }

  void put(const Met& from, const Met& to, double mean_extinction) {
    add(sum, {.from = from.depth,
              .to = to.depth,
              .optical_depth = mean_extinction * (to.depth - from.depth) * length,
              .first = from.extinction > 0.0 ? from.colour : to.colour,
              .last = to.extinction > 0.0 ? to.colour : from.colour});
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
    }
  }

 private:
  void pass(Sweep& ray, double at) const {
    if (ray.sum.is_done()) return;
    const double depth = (at - ray.start[axis_]) / ray.along[axis_];
    if (depth < 0.0) return;
    const Met met(depth, plane_.sum_at(place_of(ray, depth)));
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
      ray.meet(Met(first.depth - between, {}));
      return;
    }
    const Met start = met_at(ray, 0.0);
    const Met middle = met_at(ray, 0.5 * first.depth);
    ray.put(start, first, (start.extinction + 4.0 * middle.extinction + first.extinction) / 6.0);
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
      progress.advance(ways[way].size());
    }
  }
}

}  // namespace relief::volume_truth
