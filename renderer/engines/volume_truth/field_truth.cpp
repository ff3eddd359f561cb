#include "renderer/engines/volume_truth/field_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief::volume_truth {
namespace {

/// What halving a part of a ray may change in the ray's colour or opacity. The halves, which are
/// kept, are off by less, and a ray has some tens of parts that are visible.
constexpr double kChange = 5e-7;
/// The optical depth of parts that do not matter.
constexpr double kFaintPart = 1e-3;
constexpr int kMostHalvings = 12;
constexpr int kBisections = 40;
/// Parts of a cell in which crossings of the surface are looked for: values are cubic along a ray.
constexpr int kCrossingParts = 4;

/// Whether no value of a range is seen.
bool is_clear(const TransferFunction& function, const ValueRange& range) {
  if (range.is_empty()) return true;
  if (!is_transparent_at(function, static_cast<double>(range.low)) ||
      !is_transparent_at(function, static_cast<double>(range.high)))
    return false;
  return std::none_of(function.opacities.begin(), function.opacities.end(),
                      [&](const OpacityStop& stop) {
                        return stop.opacity > 0.0 && stop.at > static_cast<double>(range.low) &&
                               stop.at < static_cast<double>(range.high);
                      });
}

/// A place of a ray.
struct Place {
  double depth = 0.0;
  double extinction = 0.0;  ///< for a unit of depth
  glm::dvec3 colour{0.0};
};

/// Follows one ray.
class FieldRay {
 public:
  FieldRay(const FieldScene& scene, const View& view, const glm::dmat3& to_grid, glm::dvec2 window,
           double step)
      : scene_(scene), step_(step) {
    const glm::dvec3 start = ray_start(view, window);
    through_ = ray_through(view, window);
    from_eye_ = start;
    eye_ = view.eye;
    start_ = to_grid * (view.eye + start - scene.grid.origin);
    along_ = to_grid * through_;
    length_ = glm::length(through_);
  }

  RaySum trace() {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    clip(from, to);
    const double least = 1e-9 / glm::length(along_);  // of a cell: so that every step gets on
    while (from < to && !sum_.is_done()) {
      cell_ = glm::clamp(glm::ivec3(glm::floor(place_at(from + least))), glm::ivec3(0),
                         scene_.field.cells() - 1);
      if (!is_seen(scene_.field.range_of_block(cell_))) {
        from = std::max(leaves(kBlock), from + least);
        continue;
      }
      const double end = std::min(std::max(leaves(1), from + least), to);
      if (is_seen(scene_.field.range_of_cell(cell_))) cross_cell(from, end);
      from = end;
    }
    return sum_;
  }

 private:
  [[nodiscard]] glm::dvec3 place_at(double depth) const { return start_ + depth * along_; }

  /// Cuts the ray to a box.
  static void clip_to(const Bounds& box, glm::dvec3 start, glm::dvec3 along, double& from,
                      double& to) {
    for (glm::length_t a = 0; a < 3; ++a) {
      if (along[a] == 0.0) {
        if (!(start[a] >= box.min[a] && start[a] <= box.max[a])) to = -1.0;
        continue;
      }
      const double low = (box.min[a] - start[a]) / along[a];
      const double high = (box.max[a] - start[a]) / along[a];
      from = std::max(from, std::min(low, high));
      to = std::min(to, std::max(low, high));
    }
  }

  void clip(double& from, double& to) const {
    clip_to({glm::dvec3(0.0), glm::dvec3(scene_.field.cells())}, start_, along_, from, to);
    if (scene_.clip) clip_to(*scene_.clip, eye_ + from_eye_, through_, from, to);
  }

  [[nodiscard]] bool has_surface(const ValueRange& range) const {
    return scene_.iso && static_cast<double>(range.low) <= *scene_.iso &&
           *scene_.iso <= static_cast<double>(range.high);
  }
  [[nodiscard]] bool is_seen(const ValueRange& range) const {
    return !range.is_empty() && (has_surface(range) || !is_clear(scene_.function, range));
  }

  /// The depth at which the ray leaves the cell, or with kBlock the cell's block.
  [[nodiscard]] double leaves(int side) const {
    double depth = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
      if (along_[a] == 0.0) continue;
      const int face = (cell_[a] / side + (along_[a] > 0.0 ? 1 : 0)) * side;
      depth = std::min(depth, (face - start_[a]) / along_[a]);
    }
    return depth;
  }

  void cross_cell(double from, double to) {
    if (has_surface(scene_.field.range_of_cell(cell_))) {
      const double part = (to - from) / kCrossingParts;
      double low = from;
      for (int p = 0; p < kCrossingParts; ++p) {
        const double high = p + 1 == kCrossingParts ? to : low + part;
        if (const auto crossing = crossing_in(low, high)) {
          cross(from, *crossing);
          show_surface(*crossing);
          from = *crossing;
        }
        low = high;
      }
    }
    cross(from, to);
  }

  [[nodiscard]] bool is_above(double depth) const {
    return scene_.field.value_at(cell_, place_at(depth)) >= *scene_.iso;
  }

  [[nodiscard]] std::optional<double> crossing_in(double low, double high) const {
    const bool starts_above = is_above(low);
    if (is_above(high) == starts_above) return std::nullopt;
    for (int b = 0; b < kBisections; ++b) {
      const double middle = 0.5 * (low + high);
      (is_above(middle) == starts_above ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  [[nodiscard]] glm::dvec3 lit(double value, glm::dvec3 gradient, double depth) const {
    const glm::vec3 albedo = colour_at(scene_.function, value);
    const double magnitude = glm::length(gradient);
    if (scene_.lighting == nullptr || !(magnitude > 0.0)) return albedo;
    return shade(*scene_.lighting, 0,
                 {.albedo = albedo,
                  .normal = glm::vec3(-gradient / magnitude),
                  .ray = glm::vec3(through_ / length_),
                  .position = glm::vec3(from_eye_ + depth * through_)});
  }

  void show_surface(double depth) {
    const auto sample = scene_.field.sample_at(cell_, place_at(depth));
    add_surface(sum_, scene_.iso_opacity, lit(*scene_.iso, sample.gradient, depth), depth);
  }

  [[nodiscard]] Place look(double depth) const {
    Place place{.depth = depth};
    const auto sample = scene_.field.sample_at(cell_, place_at(depth));
    place.extinction =
        length_ * extinction_at(scene_.function, sample.value, glm::length(sample.gradient));
    // Where there is nothing, a colour still is: that of what begins there.
    place.colour = lit(sample.value, sample.gradient, depth);
    return place;
  }

  void cross(double from, double to) {
    if (!(to > from) || is_clear(scene_.function, scene_.field.range_of_cell(cell_))) return;
    const double spacings = (to - from) * glm::length(along_);
    const int parts = std::max(1, static_cast<int>(std::ceil(spacings / step_)));
    Place low = look(from);
    for (int p = 1; p <= parts && !sum_.is_done(); ++p) {
      const Place high = look(p == parts ? to : from + (to - from) * p / parts);
      gather(low, high, 0);
      low = high;
    }
  }

  static Segment between(const Place& a, const Place& b, double optical_depth) {
    return {.from = a.depth,
            .to = b.depth,
            .optical_depth = std::max(optical_depth, 0.0),
            .first = a.colour,
            .last = b.colour};
  }

  void gather(const Place& a, const Place& b, int halvings) {
    const Place m = look(0.5 * (a.depth + b.depth));
    const double third = (b.depth - a.depth) / 24.0;
    const double trapezoids = 6.0 * third * (a.extinction + 2.0 * m.extinction + b.extinction);
    // Those of the parabola through the three.
    const Segment first =
        between(a, m, third * (5.0 * a.extinction + 8.0 * m.extinction - b.extinction));
    const Segment second =
        between(m, b, third * (5.0 * b.extinction + 8.0 * m.extinction - a.extinction));
    if (halvings < kMostHalvings) {
      const Segment whole = between(a, b, trapezoids);
      const double let_through = std::exp(-first.optical_depth);
      const glm::dvec3 change =
          glm::abs(light_of(whole) - light_of(first) - let_through * light_of(second));
      const double opacity_change =
          std::abs(std::exp(-trapezoids) - std::exp(-first.optical_depth - second.optical_depth));
      const double most = std::max({change.x, change.y, change.z, opacity_change});
      // Three places may agree by chance, so that parts that matter are halved at least once.
      const bool is_first_look =
          halvings == 0 && first.optical_depth + second.optical_depth > kFaintPart;
      if (sum_.transmittance * most > kChange || is_first_look) {
        gather(a, m, halvings + 1);
        if (!sum_.is_done()) gather(m, b, halvings + 1);
        return;
      }
    }
    add(sum_, first);
    add(sum_, second);
  }

  const FieldScene& scene_;
  double step_;
  glm::dvec3 start_{0.0};  ///< the grid's coordinates, at depth 0
  glm::dvec3 along_{0.0};  ///< for a unit of depth
  glm::dvec3 eye_{0.0};    ///< world
  glm::dvec3 from_eye_{0.0};
  glm::dvec3 through_{0.0};  ///< world, likewise
  double length_ = 1.0;      ///< world units for a unit of depth
  glm::ivec3 cell_{0};
  RaySum sum_;
};

}  // namespace

void integrate_field(const FieldScene& scene, const View& view, double step, SampleImage& into,
                     Progress& progress) {
  const glm::ivec3 cells = scene.field.cells();
  if (cells.x <= 0 || cells.y <= 0 || cells.z <= 0) return;  // one layer encloses nothing
  const glm::dmat3 to_grid = glm::inverse(scene.grid.step);
  progress.begin_stage("following rays", into.rays.size());
  tbb::parallel_for(std::int64_t{0}, into.height, [&](std::int64_t y) {
    for (std::int64_t x = 0; x < into.width; ++x) {
      if (progress.cancelled()) return;
      into.rays[into.index(x, y)] = FieldRay(scene, view, to_grid, into.window(x, y), step).trace();
    }
    progress.advance(static_cast<std::uint64_t>(into.width));
  });
}

}  // namespace relief::volume_truth
