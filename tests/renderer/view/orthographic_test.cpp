// Orthographic images of a plane and a sphere, pixel by pixel against their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "shaders/include/shared.h"
#include "tests/renderer/view/orthographic.h"

namespace relief {
namespace {

using test::by;
using test::EngineMethod;
using test::forward;
using test::must_render;
using test::pixel_size;
using test::pixel_start;
using test::values;

class Orthographic : public testing::TestWithParam<EngineMethod> {};

/// A plane z = 0.5 x - 0.25 y of 40 nodes a side, spacing 1, about the origin.
constexpr std::uint32_t kNodes = 40;
constexpr double kHalf = 0.5 * (kNodes - 1);
const glm::dvec3 kPlaneNormal = glm::normalize(glm::dvec3(-0.5, 0.25, 1.0));

PatchModel plane_model() {
  return test::height_field(kNodes, [](double x, double y) { return 0.5 * x - 0.25 * y; });
}

/// Whether it draws cells, those that holes cut without margins.
bool draws_cells(const EngineMethod& method) {
  return method.engine == "raytrace" || method.is_cells();
}

/// How far beyond its outermost samples an engine draws a plane, in cells; nothing where that is
/// no straight edge.
std::optional<double> beyond_samples(const EngineMethod& method) {
  if (draws_cells(method))
    return 0.47;  // half a cell along the slope, from 0.447 to 0.485 over the plane
  const bool discs = method.engine == "onepass" && method.primitive == Primitive::Sprite;
  if (method.engine == "ewa" || discs) return std::nullopt;
  return 0.5;  // half a splat
}

/// How far the pieces that an engine draws a plane of reach, in cells: discs of as much as a splat
/// and its margins, kernels that end at 4 standard deviations.
double reach(const EngineMethod& method) {
  return method.engine == "ewa" ? 6.0 : 2.0;
}

/// How far depths may be off, in cells over the cosine between ray and normal.
double depth_tolerance(const EngineMethod& method) {
  // Kernels are as far apart as they are wide: the mean of planes that are all the same one, but
  // for heights and normals, both rounded to 1/1000 or better, over the two cells that they reach.
  if (method.engine == "ewa") return 0.005;
  // Heights are rounded to 1/1000 of a cell.
  if (method.engine == "raytrace" || method.is_cells()) return 0.002;
  // Slopes are rounded to half of kSteepest / 127 along both axes, over the radius of a disc.
  return 2.0 * 0.5 * shared::kSteepest / 127.0;
}

TEST_P(Orthographic, PlaneIsWhereItsFormulaSays) {
  const PatchModel model = plane_model();
  for (const glm::dvec3& toward : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.5, -0.3, 1.0)}) {
    RenderSettings settings = by(GetParam(), test::small_image(model));
    settings.camera = {40.0 * toward, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    settings.camera.orthographic_height = 50.0;
    settings.ewa.cutoff = 8.0;  // whole kernels: their means are what they should be
    const Image image = must_render(model, settings).image;
    const glm::dvec3 ray = forward(settings.camera);
    const double cosine = -glm::dot(kPlaneNormal, ray);
    const std::optional<double> beyond = beyond_samples(GetParam());
    std::size_t inside = 0;
    for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
      const glm::dvec3 start = pixel_start(settings, k % settings.width, k / settings.width);
      const double depth = glm::dot(kPlaneNormal, start) / cosine;
      const glm::dvec3 position = start + depth * ray;
      const double outermost = std::max(std::abs(position.x), std::abs(position.y)) - kHalf;
      const bool covered = values(image, "A")[k] > 0.0F;
      // A smooth curve rounds the corners of cells.
      const bool cut = draws_cells(GetParam()) &&
                       std::min(std::abs(position.x), std::abs(position.y)) > kHalf - 2.0;
      // Edges are rounded by kMinMargin and kMarginPixels at most. Discs and kernels reach
      // further than half a cell, and over the corners by less than what covers a cell.
      const double slack = 0.025 + 0.02 * pixel_size(settings);
      if (outermost < (cut ? 0.0 : beyond.value_or(0.0)) - slack) {
        ASSERT_TRUE(covered) << k;
      } else if (outermost > beyond.value_or(reach(GetParam())) + slack) {
        ASSERT_FALSE(covered) << k;
        ASSERT_EQ(values(image, "Z")[k], std::numeric_limits<float>::infinity());
      }
      if (outermost > -reach(GetParam())) continue;
      ++inside;
      ASSERT_NEAR(values(image, "Z")[k], depth, depth_tolerance(GetParam()) / cosine) << k;
      // Half floats, of multipass summed up.
      ASSERT_LT(glm::distance(test::normal_at(image, k), kPlaneNormal), 0.002) << k;
      // A texel of 8192 a cell, or how far a slope's rounding moves the place.
      ASSERT_NEAR(values(image, "UV.U")[k], position.x + kHalf, 0.05) << k;
      ASSERT_NEAR(values(image, "UV.V")[k], position.y + kHalf, 0.05) << k;
      ASSERT_EQ(values(image, "patch")[k], 1.0F);
    }
    EXPECT_GT(inside, 1500U);
  }
}

/// Where a ray from `start` (relative to the centre) along `ray` meets a sphere behind it.
std::optional<double> meet_sphere(glm::dvec3 start, glm::dvec3 ray, double radius) {
  const double along = glm::dot(start, ray);
  const double squared = along * along - glm::dot(start, start) + radius * radius;
  if (squared < 0.0) return std::nullopt;
  const double half = std::sqrt(squared);
  if (-along - half > 0.0) return -along - half;
  if (-along + half > 0.0) return -along + half;
  return std::nullopt;
}

/// An image of a sphere: how right it is where it is seen at more than 20 degrees, and at the rim.
struct SphereErrors {
  double normal_degrees = 0.0;  ///< rms
  double depth_cells = 0.0;     ///< rms
  std::size_t pixels = 0;
  std::size_t holes = 0;  ///< what is missing or seen behind it
  std::size_t rim = 0;    ///< pixels that are wrongly covered, or not, more than 1.5 from the rim
};

SphereErrors sphere_errors(const test::SphereShape& shape, const RenderSettings& settings,
                           const Image& image) {
  SphereErrors errors;
  const glm::dvec3 ray = forward(settings.camera);
  for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
    const glm::dvec3 start =
        pixel_start(settings, k % settings.width, k / settings.width) - shape.centre;
    const double across = glm::length(start - glm::dot(start, ray) * ray);
    const bool covered = values(image, "A")[k] > 0.0F;
    const bool near_rim = std::abs(across - shape.radius) < 1.5 * pixel_size(settings);
    if (!near_rim && covered != (across < shape.radius)) ++errors.rim;
    const std::optional<double> depth = meet_sphere(start, ray, shape.radius);
    if (!depth) continue;
    const glm::dvec3 normal = (start + *depth * ray) / shape.radius;
    if (std::abs(glm::dot(normal, ray)) < std::sin(20.0 * std::acos(-1.0) / 180.0)) continue;
    ++errors.pixels;
    const double off = (values(image, "Z")[k] - *depth) / shape.spacing;
    if (!covered || !(off < 2.0)) {
      ++errors.holes;
      continue;
    }
    const double sine = glm::length(glm::cross(test::normal_at(image, k), normal));
    errors.normal_degrees += std::pow(std::asin(std::min(sine, 1.0)) * 180.0 / std::acos(-1.0), 2);
    errors.depth_cells += off * off;
  }
  const auto count = static_cast<double>(errors.pixels);
  errors.normal_degrees = std::sqrt(errors.normal_degrees / count);
  errors.depth_cells = std::sqrt(errors.depth_cells / count);
  return errors;
}

test::SphereShape sphere_shape() {
  test::SphereShape shape;
  shape.centre = {3.0, -2.0, 1.0};
  shape.overlap_cells = 3.0;  // so that whole cells alone, as raytrace has them, leave no gap
  return shape;
}

TEST_P(Orthographic, SphereOfManyPatchesHasNoHolesAndItsOwnNormals) {
  const test::SphereShape shape = sphere_shape();
  const PatchModel model = test::sphere_model(shape);
  for (const double height : {2.4, 0.7}) {
    RenderSettings settings = by(GetParam(), test::small_image(model, {30.0, 20.0}));
    settings.camera.orthographic_height = height;
    const SphereErrors errors = sphere_errors(shape, settings, must_render(model, settings).image);
    EXPECT_GT(errors.pixels, 3500U);
    EXPECT_EQ(errors.holes, 0U) << height;
    // The tolerances of Surfaces, for the same reasons. Splats that blend are seen through as much
    // of the sphere as they reach: discs of twice the radius, 1.4 cells, are off it by half of its
    // square over a radius of 20 cells.
    const bool blends = GetParam().engine == "multipass" || GetParam().engine == "ewa";
    EXPECT_LT(errors.normal_degrees, blends ? 0.6 : 0.2) << height;
    EXPECT_LT(errors.depth_cells, blends ? 0.15 : 0.04) << height;
    // Discs in the plane of a splat at the rim stick out by as little as what is off it; a kernel
    // of ewa reaches two pixels.
    if (GetParam().engine != "ewa") {
      EXPECT_EQ(errors.rim, 0U) << height;
    }
  }
}

TEST_P(Orthographic, WhatIsBehindTheEyesPlaneIsCutOff) {
  const test::SphereShape shape = sphere_shape();
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = by(GetParam(), test::small_image(model));
  const glm::dvec3 toward = glm::normalize(glm::dvec3(1.0, 0.4, 2.0));
  settings.camera = {shape.centre + 0.3 * toward, shape.centre, {0.0, 1.0, 0.0}};
  settings.camera.orthographic_height = 2.2;
  const Image image = must_render(model, settings).image;
  const glm::dvec3 ray = forward(settings.camera);
  std::size_t within = 0;
  for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
    const glm::dvec3 start =
        pixel_start(settings, k % settings.width, k / settings.width) - shape.centre;
    const double across = glm::length(start - glm::dot(start, ray) * ray);
    // Where the plane cuts the sphere it is seen from without beyond, and from within before that.
    // A kernel of ewa, which has no half, is a cell or two wide.
    const double cut = std::sqrt(1.0 - 0.3 * 0.3);
    const double width = GetParam().engine == "ewa" ? 0.15 : 0.03;
    if (std::abs(across - cut) < width || std::abs(across - 1.0) < 0.1) continue;
    if (across > 1.0) {
      ASSERT_EQ(values(image, "A")[k], 0.0F) << k;
      continue;
    }
    ++within;
    const std::optional<double> depth = meet_sphere(start, ray, shape.radius);
    ASSERT_TRUE(depth);
    ASSERT_GT(values(image, "A")[k], 0.0F) << k;
    // Half a cell of a splat's plane, or the two of a kernel's, at less than 64 degrees.
    ASSERT_NEAR(values(image, "Z")[k], *depth, 0.02) << k << " " << across;
  }
  EXPECT_GT(within, 3000U);
}

TEST_P(Orthographic, EyesPlaneCutsToThePixel) {
  // Points of ewa are seen whole or not at all.
  if (GetParam().engine == "ewa") return;
  const PatchModel model = plane_model();
  RenderSettings settings = by(GetParam(), test::small_image(model));
  settings.camera = {{0.0, 0.0, 0.0}, {-1.0, -0.4, -1.0}, {0.0, 1.0, 0.0}};
  settings.camera.orthographic_height = 30.0;
  const Image image = must_render(model, settings).image;
  const glm::dvec3 ray = forward(settings.camera);
  const double cosine = -glm::dot(kPlaneNormal, ray);
  std::size_t seen = 0;
  std::size_t cut = 0;
  for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
    const glm::dvec3 start = pixel_start(settings, k % settings.width, k / settings.width);
    const double depth = glm::dot(kPlaneNormal, start) / cosine;
    const glm::dvec3 position = start + depth * ray;
    if (std::max(std::abs(position.x), std::abs(position.y)) > kHalf - 2.0) continue;
    // Pass 1 of multipass sets all of the surface back before it is cut.
    const double early = GetParam().engine == "multipass" ? double{shared::kBlendingDepth} : 0.0;
    const double slack = depth_tolerance(GetParam()) / std::abs(cosine);
    if (depth < slack && depth > -early - slack) continue;
    ASSERT_EQ(values(image, "A")[k] > 0.0F, depth > 0.0) << k << " " << depth;
    ++(depth > 0.0 ? seen : cut);
  }
  EXPECT_GT(seen, 1000U);
  EXPECT_GT(cut, 1000U);
}

INSTANTIATE_TEST_SUITE_P(All, Orthographic, testing::ValuesIn(test::all_engine_methods()),
                         test::name_of_method);

}  // namespace
}  // namespace relief
