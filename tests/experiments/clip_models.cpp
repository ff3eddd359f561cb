#include "tests/experiments/clip_models.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

namespace relief::experiment {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

SmoothFace flat(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, double coarseness = 1.0) {
  return {[=](double a, double b) { return corner + a * u + b * v; }, glm::length(glm::cross(u, v)),
          coarseness};
}

/// The side of a cylinder along z.
SmoothFace round_side(glm::dvec2 axis, double radius, double low, double high) {
  return {[=](double a, double b) {
            return glm::dvec3(axis.x + radius * std::cos(kTurn * a),
                              axis.y + radius * std::sin(kTurn * a), low + b * (high - low));
          },
          kTurn * radius * (high - low), 1.0};
}

/// Height above a half-space.
double above(glm::dvec3 p, glm::dvec3 on, glm::dvec3 normal) {
  return glm::dot(p - on, glm::normalize(normal));
}

double box(glm::dvec3 p, glm::dvec3 low, glm::dvec3 high) {
  const glm::dvec3 out = glm::max(low - p, p - high);
  return std::max({out.x, out.y, out.z});
}

double pillar(glm::dvec3 p, glm::dvec2 axis, double radius, double low, double high) {
  return std::max({std::hypot(p.x - axis.x, p.y - axis.y) - radius, low - p.z, p.z - high});
}

/// The six faces of a box.
void add_box(std::vector<SmoothFace>& faces, glm::dvec3 low, glm::dvec3 high,
             double coarse_top = 1.0) {
  const glm::dvec3 x(high.x - low.x, 0, 0);
  const glm::dvec3 y(0, high.y - low.y, 0);
  const glm::dvec3 z(0, 0, high.z - low.z);
  faces.push_back(flat(low, x, y));
  faces.push_back(flat(low + z, x, y, coarse_top));
  faces.push_back(flat(low, x, z));
  faces.push_back(flat(low + y, x, z));
  faces.push_back(flat(low, y, z));
  faces.push_back(flat(low + x, y, z));
}

SharpModel cube(double coarse_top) {
  SharpModel model{coarse_top == 1.0 ? "cube" : "cube, coarse top", {}, {}};
  model.height = [](glm::dvec3 p) { return box(p, glm::dvec3(-1), glm::dvec3(1)); };
  add_box(model.faces, glm::dvec3(-1), glm::dvec3(1), coarse_top);
  return model;
}

SharpModel cylinder() {
  SharpModel model{"cylinder", {}, {}};
  model.height = [](glm::dvec3 p) { return pillar(p, glm::dvec2(0), 1.0, -1.0, 1.0); };
  model.faces = {flat({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), flat({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}),
                 round_side(glm::dvec2(0), 1.0, -1.0, 1.0)};
  return model;
}

/// A round plate with a peg and a blind hole: the four cells of Figure 5.
SharpModel plate() {
  const glm::dvec2 peg(-0.5, 0);
  const glm::dvec2 hole(0.5, 0);
  SharpModel model{"plate, peg and hole", {}, {}};
  model.height = [=](glm::dvec3 p) {
    const double solid =
        std::min(pillar(p, glm::dvec2(0), 1.1, -0.5, 0.0), pillar(p, peg, 0.3, -0.4, 0.5));
    return std::max(solid, -pillar(p, hole, 0.3, -0.3, 0.5));
  };
  const auto square = [](double z) { return flat({-1.1, -1.1, z}, {2.2, 0, 0}, {0, 2.2, 0}); };
  model.faces = {square(-0.5),
                 square(0.0),
                 square(0.5),
                 square(-0.3),
                 round_side(glm::dvec2(0), 1.1, -0.5, 0.0),
                 round_side(peg, 0.3, 0.0, 0.5),
                 round_side(hole, 0.3, -0.3, 0.0)};
  return model;
}

/// A plate with a square peg and a square hole: their corners are intersections.
SharpModel square_plate() {
  SharpModel model{"plate, square peg and hole", {}, {}};
  const glm::dvec3 peg_low(-0.8, -0.3, -0.4);
  const glm::dvec3 peg_high(-0.2, 0.3, 0.5);
  const glm::dvec3 hole_low(0.2, -0.3, -0.3);
  const glm::dvec3 hole_high(0.8, 0.3, 0.5);
  model.height = [=](glm::dvec3 p) {
    const double solid =
        std::min(box(p, {-1.1, -1.1, -0.5}, {1.1, 1.1, 0.0}), box(p, peg_low, peg_high));
    return std::max(solid, -box(p, hole_low, hole_high));
  };
  add_box(model.faces, {-1.1, -1.1, -0.5}, {1.1, 1.1, 0.0});
  add_box(model.faces, {peg_low.x, peg_low.y, 0.0}, peg_high);
  add_box(model.faces, hole_low, {hole_high.x, hole_high.y, 0.0});
  return model;
}

/// Three cubes of eight: corners of three convex, two convex and a concave, and of six faces.
SharpModel steps() {
  SharpModel model{"steps", {}, {}};
  model.height = [](glm::dvec3 p) {
    const double low = box(p, {-1, -1, -1}, {1, 1, 0});
    const double middle = box(p, {-1, -1, -0.5}, {1, 0, 0.5});
    const double high = box(p, {-1, -1, -0.5}, {0, 0, 1});
    return std::min({low, middle, high});
  };
  add_box(model.faces, {-1, -1, -1}, {1, 1, 0});
  add_box(model.faces, {-1, -1, 0}, {1, 0, 0.5});
  add_box(model.faces, {-1, -1, 0.5}, {0, 0, 1});
  return model;
}

/// A pyramid, or a pyramid-shaped hole in a block: a corner of some faces.
SharpModel pyramid(int sides, bool is_hole) {
  SharpModel model{
      is_hole ? "pyramid hole, " + std::to_string(sides) : "pyramid, " + std::to_string(sides),
      {},
      {}};
  const double slope = 1.0;
  const auto cone = [=](glm::dvec3 p) {
    double most = -1e9;
    for (int k = 0; k < sides; ++k) {
      const double angle = kTurn * (k + 0.5) / sides;
      most = std::max(most,
                      above(p, {0, 0, 1}, {slope * std::cos(angle), slope * std::sin(angle), 1}));
    }
    return most;
  };
  if (is_hole) {
    // The tip points down, in a block.
    model.height = [=](glm::dvec3 p) {
      return std::max(box(p, {-1.5, -1.5, -1.3}, {1.5, 1.5, 0.0}), -cone({p.x, p.y, -p.z}));
    };
    add_box(model.faces, {-1.5, -1.5, -1.3}, {1.5, 1.5, 0.0});
  } else {
    model.height = [=](glm::dvec3 p) { return std::max(cone(p), -p.z); };
    model.faces.push_back(flat({-2.5, -2.5, 0}, {5, 0, 0}, {0, 5, 0}));
  }
  for (int k = 0; k < sides; ++k) {
    const double angle = kTurn * (k + 0.5) / sides;
    const glm::dvec3 across(-std::sin(angle), std::cos(angle), 0);
    const double sign = is_hole ? -1.0 : 1.0;
    const glm::dvec3 down(std::cos(angle), std::sin(angle), -sign);
    model.faces.push_back(flat(glm::dvec3(0, 0, sign) - 2.0 * across, 4.0 * across, down));
  }
  return model;
}

/// A prism whose outline is a wave: its edge bends to both sides.
SharpModel wave() {
  SharpModel model{"wave", {}, {}};
  const auto outline = [](double angle) { return 1.0 + 0.15 * std::cos(5.0 * angle); };
  model.height = [=](glm::dvec3 p) {
    const double angle = std::atan2(p.y, p.x);
    const double radius = outline(angle);
    const double slope = 0.75 * std::sin(5.0 * angle) / radius;
    const double side = (std::hypot(p.x, p.y) - radius) / std::sqrt(1.0 + slope * slope);
    return std::max({side, -0.4 - p.z, p.z - 0.4});
  };
  model.faces = {flat({-1.2, -1.2, -0.4}, {2.4, 0, 0}, {0, 2.4, 0}),
                 flat({-1.2, -1.2, 0.4}, {2.4, 0, 0}, {0, 2.4, 0}),
                 {[=](double a, double b) {
                    const double angle = kTurn * a;
                    return glm::dvec3(outline(angle) * std::cos(angle),
                                      outline(angle) * std::sin(angle), -0.4 + 0.8 * b);
                  },
                  kTurn * 1.15 * 0.8, 1.0}};
  return model;
}

/// A half ball on its flat side, with a bowl in it: curved surfaces on both sides of edges.
SharpModel bowl() {
  SharpModel model{"bowl", {}, {}};
  const glm::dvec3 centre(0, 0, 0.7);
  model.height = [=](glm::dvec3 p) {
    return std::max({glm::length(p) - 1.2, -0.5 - p.z, 0.8 - glm::length(p - centre), p.z - 0.7});
  };
  const auto ball = [](glm::dvec3 middle, double radius) {
    return SmoothFace{[=](double a, double b) {
                        const double z = 2.0 * b - 1.0;
                        const double across = std::sqrt(1.0 - z * z);
                        return middle + radius * glm::dvec3(across * std::cos(kTurn * a),
                                                            across * std::sin(kTurn * a), z);
                      },
                      2.0 * kTurn * radius * radius, 1.0};
  };
  model.faces = {ball(glm::dvec3(0), 1.2), ball(centre, 0.8),
                 flat({-1.2, -1.2, -0.5}, {2.4, 0, 0}, {0, 2.4, 0}),
                 flat({-1.2, -1.2, 0.7}, {2.4, 0, 0}, {0, 2.4, 0})};
  return model;
}

SharpModel ball() {
  SharpModel model{"ball (smooth)", {}, {}};
  model.height = [](glm::dvec3 p) { return glm::length(p) - 1.0; };
  model.faces = {{[](double a, double b) {
                    const double z = 2.0 * b - 1.0;
                    const double across = std::sqrt(1.0 - z * z);
                    return glm::dvec3(across * std::cos(kTurn * a), across * std::sin(kTurn * a),
                                      z);
                  },
                  2.0 * kTurn, 1.0}};
  return model;
}

glm::dvec3 normal_at(const SharpModel& model, const SmoothFace& face, double a, double b) {
  constexpr double kStep = 1e-6;
  const glm::dvec3 p = face.at(a, b);
  const glm::dvec3 n = glm::normalize(glm::cross(face.at(a + kStep, b) - face.at(a - kStep, b),
                                                 face.at(a, b + kStep) - face.at(a, b - kStep)));
  return model.height(p + 1e-6 * n) > model.height(p - 1e-6 * n) ? n : -n;
}

/// Whether a position of a face is on the surface, with air on one side and the solid on the other.
bool is_surface(const SharpModel& model, glm::dvec3 p, glm::dvec3 n) {
  return std::abs(model.height(p)) < 1e-9 && model.height(p + 1e-6 * n) > 1e-7 &&
         model.height(p - 1e-6 * n) < -1e-7;
}

}  // namespace

std::vector<SharpModel> sharp_models() {
  return {cube(1.0),
          cube(4.0),
          cylinder(),
          plate(),
          square_plate(),
          steps(),
          pyramid(3, false),
          pyramid(4, false),
          pyramid(5, false),
          pyramid(3, true),
          pyramid(4, true),
          pyramid(5, true),
          wave(),
          bowl(),
          ball()};
}

std::vector<SurfacePoint> even_points(const SharpModel& model, double spacing, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<SurfacePoint> points;
  for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
    const SmoothFace& face = model.faces[f];
    const double apart = spacing * face.coarseness;
    std::map<std::tuple<int, int, int>, std::vector<glm::dvec3>> cells;
    const auto cell = [&](glm::dvec3 p) {
      return std::tuple(static_cast<int>(std::floor(p.x / apart)),
                        static_cast<int>(std::floor(p.y / apart)),
                        static_cast<int>(std::floor(p.z / apart)));
    };
    const auto has_room = [&](glm::dvec3 p) {
      const auto [x, y, z] = cell(p);
      for (int i = x - 1; i <= x + 1; ++i)
        for (int j = y - 1; j <= y + 1; ++j)
          for (int k = z - 1; k <= z + 1; ++k)
            if (const auto found = cells.find({i, j, k}); found != cells.end())
              for (const glm::dvec3 other : found->second)
                if (glm::distance(p, other) < apart) return false;
      return true;
    };
    // 60 darts for each place leave few gaps.
    const auto darts = static_cast<std::size_t>(60.0 * face.area / (apart * apart));
    for (std::size_t d = 0; d < darts; ++d) {
      const double a = unit(random);
      const double b = unit(random);
      const glm::dvec3 p = face.at(a, b);
      if (std::abs(model.height(p)) > 1e-9 || !has_room(p)) continue;
      const glm::dvec3 n = normal_at(model, face, a, b);
      if (!is_surface(model, p, n)) continue;
      cells[cell(p)].push_back(p);
      points.push_back({p, n, f});
    }
  }
  return points;
}

std::vector<SurfacePoint> random_points(const SharpModel& model, std::size_t count,
                                        std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double area = 0.0;
  for (const SmoothFace& face : model.faces) area += face.area;
  std::vector<SurfacePoint> points;
  for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
    const auto tries =
        static_cast<std::size_t>(static_cast<double>(count) * model.faces[f].area / area);
    for (std::size_t t = 0; t < tries; ++t) {
      const double a = unit(random);
      const double b = unit(random);
      const glm::dvec3 p = model.faces[f].at(a, b);
      if (std::abs(model.height(p)) > 1e-9) continue;
      const glm::dvec3 n = normal_at(model, model.faces[f], a, b);
      if (is_surface(model, p, n)) points.push_back({p, n, f});
    }
  }
  return points;
}

}  // namespace relief::experiment
