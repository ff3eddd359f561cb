#include "renderer/engines/volume_truth/gaussian_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "renderer/volume/splats/ray_space.h"
#include "renderer/volume/splats/tile_lists.h"

namespace relief::volume_truth {
namespace {

/// Fainter than any that is seen, if the settings leave out none.
constexpr double kFaintest = 1e-9;

/// The inverse of the lower triangular root of a variance, by Cholesky. None if that is singular.
std::optional<glm::dmat3> inverse_root_of(const Variance& v) {
  const double a = std::sqrt(v.xx);
  const double b = v.xy / a;
  const double c = v.xz / a;
  const double d = std::sqrt(v.yy - b * b);
  const double e = (v.yz - b * c) / d;
  const double f = std::sqrt(v.zz - c * c - e * e);
  const glm::dmat3 inverse = glm::inverse(glm::dmat3({a, b, c}, {0.0, d, e}, {0.0, 0.0, f}));
  for (int column = 0; column < 3; ++column) {
    if (!std::isfinite(glm::dot(inverse[column], inverse[column]))) return std::nullopt;
  }
  return inverse;
}

struct Span {
  double middle = 0.0;
  double half = 0.0;
};

/// Where rays that touch an ellipsoid cross the image along one axis: the planes through the eye
/// that touch it are the roots of a parabola. `v`: its variance times its squared radius; camera
/// space. None where it reaches the eye's plane: then all rays may.
std::optional<Span> seen_span(double x, double z, double v_xx, double v_xz, double v_zz) {
  const double a = z * z - v_zz;
  if (!(z > 0.0 && a > 0.0)) return std::nullopt;
  const double b = x * z - v_xz;
  const double root = std::sqrt(std::max(b * b - a * (x * x - v_xx), 0.0));
  return Span{b / a, root / a};
}

/// The rectangle of rays that meet the ellipsoid where x^T Q x is `cutoff`, as a footprint.
Footprint bound_of(const KernelCloud& cloud, std::size_t k, const RayCamera& camera, double cutoff,
                   const SampleImage& image) {
  const glm::dvec3 t = to_camera(camera, cloud.centres[k]);
  const glm::dmat3 v =
      cutoff * (camera.rotation * matrix_of(cloud.variance(k)) * glm::transpose(camera.rotation));
  Footprint bound;
  bound.depth = t.z;
  for (int a = 0; a < 2; ++a) {
    const std::optional<Span> span = camera.orthographic
                                         ? Span{t[a], std::sqrt(v[a][a])}
                                         : seen_span(t[a], t.z, v[a][a], v[2][a], v[2][2]);
    const double whole = static_cast<double>(image.width + image.height);
    const double middle =
        span ? (camera.middle[a] + camera.scale[a] * span->middle + image.border) * image.side
             : 0.0;
    bound.centre[a] = middle;
    // One ray more on either side, against rounding.
    bound.reach[a] = span ? camera.scale[a] * span->half * image.side + 1.0 : whole;
  }
  return bound;
}

/// Where a ray is nearest to a Gaussian's centre, measured by its standard deviations.
struct NearestPlace {
  double depth = 0.0;    ///< in units of `along`; at least 0
  double squared = 0.0;  ///< the Mahalanobis distance there
};

/// `inverse_root`: of the variance, which makes the Gaussian a unit one.
NearestPlace nearest_place(const glm::dmat3& inverse_root, glm::dvec3 centre, glm::dvec3 start,
                           glm::dvec3 along) {
  const glm::dvec3 to_centre = inverse_root * (centre - start);
  const glm::dvec3 step = inverse_root * along;
  const double depth = std::max(glm::dot(step, to_centre) / glm::dot(step, step), 0.0);
  const glm::dvec3 left_over = to_centre - depth * step;
  return {depth, glm::dot(left_over, left_over)};
}

/// A Gaussian on a ray.
struct MetGaussian {
  double order = 0.0;
  double depth = 0.0;
  double alpha = 0.0;
  std::uint32_t kernel = 0;

  bool operator<(const MetGaussian& other) const {
    return order != other.order ? order < other.order : kernel < other.kernel;
  }
};

RaySum composited(std::vector<MetGaussian>& met, std::span<const glm::vec3> colours,
                  const GaussianSettings& settings) {
  std::sort(met.begin(), met.end());
  RaySum sum;
  for (const MetGaussian& gaussian : met) {
    // As [Kerbl 2023] does: what would end a pixel is left out.
    if (sum.transmittance * (1.0 - gaussian.alpha) < settings.min_transmittance) break;
    add_surface(sum, gaussian.alpha, colours[gaussian.kernel], gaussian.depth);
  }
  return sum;
}

}  // namespace

void meet_gaussians(const KernelCloud& cloud, std::span<const glm::vec3> colours, const View& view,
                    const GaussianSettings& settings, GaussianOrder order, SampleImage& into,
                    Progress& progress) {
  const RayCamera camera = ray_camera(view);
  const double near = camera.orthographic ? 0.0 : settings.near;
  const double faintest = std::max(settings.min_alpha, kFaintest);
  std::vector<PlacedSplat> bounds;
  std::vector<glm::dmat3> roots;
  for (std::size_t k = 0; k < cloud.count(); ++k) {
    const double weight = cloud.weights[k];
    if (!(weight > faintest) || !(to_camera(camera, cloud.centres[k]).z > near)) continue;
    const auto root = inverse_root_of(cloud.variance(k));
    if (!root) continue;
    const Footprint bound = bound_of(cloud, k, camera, 2.0 * std::log(weight / faintest), into);
    if (!std::isfinite(bound.reach.x + bound.reach.y + bound.centre.x + bound.centre.y)) continue;
    bounds.push_back({bound, static_cast<std::uint32_t>(k)});
    roots.push_back(*root);
  }
  SplatOrder all;
  for (std::size_t s = 0; s < bounds.size(); ++s)
    all.splats.push_back({static_cast<std::uint32_t>(s), 0});
  const Tiling tiling{into.width, into.height};
  const TileLists lists(tiling, bounds, all);
  progress.begin_stage("meeting Gaussians", tiling.count());
  tbb::parallel_for(std::size_t{0}, tiling.count(), [&](std::size_t tile) {
    const PixelBox box = tiling.box(tile);
    std::vector<MetGaussian> met;
    for (std::int64_t y = box.top; y <= box.bottom; ++y) {
      for (std::int64_t x = box.left; x <= box.right; ++x) {
        if (progress.cancelled()) return;
        const glm::dvec2 window = into.window(x, y);
        const glm::dvec3 start = view.eye + ray_start(view, window);
        const glm::dvec3 along = ray_through(view, window);
        met.clear();
        for (const OrderedSplat& entry : lists.list(tile)) {
          const PlacedSplat& bound = bounds[entry.splat];
          const NearestPlace place =
              nearest_place(roots[entry.splat], cloud.centres[bound.kernel], start, along);
          const double alpha = std::min(
              cloud.weights[bound.kernel] * std::exp(-0.5 * place.squared), settings.max_alpha);
          if (alpha < faintest) continue;
          met.push_back({order == GaussianOrder::Ray ? place.depth : bound.footprint.depth,
                         place.depth, alpha, bound.kernel});
        }
        into.rays[into.index(x, y)] = composited(met, colours, settings);
      }
    }
    progress.advance(1);
  });
}

}  // namespace relief::volume_truth
