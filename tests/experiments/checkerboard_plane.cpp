#include "tests/experiments/checkerboard_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "renderer/view/view.h"

namespace relief::experiment {
namespace {

constexpr double kFieldOfView = 30.0;
constexpr std::uint32_t kRays = 32;  // along each side of a pixel
constexpr double kMargin = 8.0;      // spacings

/// The eye stands at negative y and looks toward positive y, where the horizon is.
class Ground {
 public:
  Ground(const PlaneView& view, std::uint32_t side)
      : side_(side),
        camera_(camera_of(view, side)),
        view_(make_view(camera_, side, side, 1.0)),
        end_(camera_.eye.y + kFar) {}

  /// The line across the view at which the plane ends.
  [[nodiscard]] double end() const { return end_; }

  /// Where the ray through a place of the image (from its upper left corner) meets the plane.
  [[nodiscard]] std::optional<glm::dvec2> at(glm::dvec2 place) const {
    const glm::dvec3 ray = ray_through(view_, {place.x, side_ - place.y});
    if (!(ray.z < 0.0)) return std::nullopt;
    const glm::dvec2 met = glm::dvec2(camera_.eye) - camera_.eye.z / ray.z * glm::dvec2(ray);
    if (met.y > end_) return std::nullopt;
    return met;
  }

  /// The same, or where the ray passes above the end of the plane.
  [[nodiscard]] glm::dvec2 at_or_end(glm::dvec2 place) const {
    if (const auto met = at(place)) return *met;
    const glm::dvec3 ray = ray_through(view_, {place.x, side_ - place.y});
    return {camera_.eye.x + (end_ - camera_.eye.y) / ray.y * ray.x, end_};
  }

 private:
  double side_;
  Camera camera_;
  View view_;
  double end_;
};

glm::dvec2 turned(glm::dvec2 p, double degrees) {
  const double c = std::cos(glm::radians(degrees));
  const double s = std::sin(glm::radians(degrees));
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// 1 and -1 by turns; nodes lie at half spacings, so that none is on an edge.
double sign_at(double x) {
  return std::fmod(std::floor(x / kSquare), 2.0) == 0.0 ? 1.0 : -1.0;
}

/// What Gaussians at the nodes make of sign_at, normalised. The basis of a regular grid is a
/// product over both axes, and so is the checkerboard's sign.
double smooth_sign_at(double x) {
  constexpr int kNodeReach = 4;  // exp(-c) with c = 8
  const double first = std::floor(x) - kNodeReach + 0.5;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i <= 2 * kNodeReach; ++i) {
    const double node = first + i;
    if (std::abs(node - x) > kNodeReach) continue;
    const double weight = std::exp(-0.5 * (node - x) * (node - x));
    sum += weight * sign_at(node);
    weights += weight;
  }
  return sum / weights;
}

glm::dvec4 grey(double sign) {
  return {glm::dvec3(0.5 + 0.5 * sign), 1.0};
}

}  // namespace

Camera camera_of(const PlaneView& view, std::uint32_t side) {
  const double inclination = glm::radians(view.inclination);
  const double focal = 0.5 * side / std::tan(glm::radians(kFieldOfView) / 2.0);
  Camera camera;
  camera.vertical_fov_degrees = kFieldOfView;
  camera.target = glm::dvec3(0.0);
  camera.eye = focal / view.pixels * glm::dvec3(0.0, -std::sin(inclination), std::cos(inclination));
  return camera;
}

SplatCloud plane_points(const PlaneView& view, std::uint32_t side) {
  const Ground ground(view, side);
  constexpr double kBeside = 16.0;  // pixels: the kernels' own low-pass reaches 4
  const double proxy_corner = side + kBeside;
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  for (const double x : {-kBeside, proxy_corner}) {
    for (const double y : {-kBeside, proxy_corner}) {
      low = glm::min(low, ground.at_or_end({x, y}));
      high = glm::max(high, ground.at_or_end({x, y}));
    }
  }
  low -= kMargin;
  high += kMargin;
  glm::dvec2 first(1e300);
  glm::dvec2 last(-1e300);
  for (const glm::dvec2 corner :
       {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
    first = glm::min(first, turned(corner, -kTurn));
    last = glm::max(last, turned(corner, -kTurn));
  }
  SplatCloud cloud;
  for (double j = std::floor(first.y) + 0.5; j < last.y; ++j) {
    for (double i = std::floor(first.x) + 0.5; i < last.x; ++i) {
      const glm::dvec2 p = turned({i, j}, kTurn);
      if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > std::min(high.y, ground.end()))
        continue;
      cloud.positions.emplace_back(p, 0.0);
      cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
      cloud.radii.push_back(1.0);
      cloud.colours.emplace_back(grey(sign_at(i) * sign_at(j)));
    }
  }
  return cloud;
}

PlaneTruths plane_truths(const PlaneView& view, std::uint32_t side) {
  const Ground ground(view, side);
  const auto trace = [&](double (*sign)(double)) {
    return filter_samples(side, kRays, [&ground, sign](glm::dvec2 place) {
      const auto met = ground.at(place);
      if (!met) return glm::dvec4(0.0);
      const glm::dvec2 p = turned(*met, -kTurn);
      return grey(sign(p.x) * sign(p.y));
    });
  };
  return {trace(sign_at), trace(smooth_sign_at)};
}

std::vector<Mapping> find_mappings(const PlaneView& view, std::uint32_t side) {
  const Ground ground(view, side);
  const auto mapping_at = [&](glm::dvec2 place) {
    constexpr double kStep = 1e-3;  // pixels
    const auto here = ground.at(place);
    const auto right = ground.at(place + glm::dvec2(kStep, 0.0));
    const auto below = ground.at(place + glm::dvec2(0.0, kStep));
    if (!here || !right || !below) return Mapping::Minified;
    const glm::dmat2 jacobian =
        glm::inverse(glm::dmat2((*right - *here) / kStep, (*below - *here) / kStep));
    // Singular values s >= t: s^2 + t^2 is the sum of squares, s t the determinant.
    const double squares = glm::dot(jacobian[0], jacobian[0]) + glm::dot(jacobian[1], jacobian[1]);
    const double product = glm::determinant(jacobian);
    const double root = std::sqrt(std::max(squares * squares - 4.0 * product * product, 0.0));
    if (squares - root >= 2.0) return Mapping::Magnified;
    return squares + root >= 2.0 ? Mapping::Anisotropic : Mapping::Minified;
  };
  std::vector<Mapping> mappings;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) mappings.push_back(mapping_at({x + 0.5, y + 0.5}));
  }
  return mappings;
}

}  // namespace relief::experiment
