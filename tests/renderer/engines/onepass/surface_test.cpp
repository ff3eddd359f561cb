// Where fragments land, against surfaces that are known.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <random>

#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::all_methods;
using test::Method;
using test::must_render;
using test::pixel_ray;
using test::small_image;
using test::values;

class Surfaces : public testing::TestWithParam<Method> {};

/// Rms errors of a rendered sphere, over pixels that see it at more than 20 degrees.
struct SurfaceErrors {
  double normal_degrees = 0.0;
  double depth_cells = 0.0;
  std::size_t holes = 0;
  std::size_t pixels = 0;
};

SurfaceErrors sphere_errors(const test::SphereShape& shape, RenderSettings settings,
                            const PatchModel& model) {
  settings.outputs = test::all_outputs();
  const RenderResult result = must_render(model, settings);
  SurfaceErrors errors;
  if (result.image.channels.empty()) return errors;
  for (std::size_t y = 0; y < settings.height; ++y) {
    for (std::size_t x = 0; x < settings.width; ++x) {
      const glm::dvec3 ray = pixel_ray(settings, x, y);
      const glm::dvec3 eye = settings.camera.eye - shape.centre;
      const double a = glm::dot(ray, ray);
      const double b = glm::dot(ray, eye);
      const double c = glm::dot(eye, eye) - shape.radius * shape.radius;
      if (b * b - a * c <= 0.0) continue;
      const double depth = (-b - std::sqrt(b * b - a * c)) / a;
      const glm::dvec3 normal = glm::normalize(eye + depth * ray);
      if (-glm::dot(normal, glm::normalize(ray)) < std::sin(20.0 * std::acos(-1.0) / 180.0))
        continue;
      const std::size_t k = y * settings.width + x;
      ++errors.pixels;
      const double depth_error = (values(result.image, "Z")[k] - depth) / shape.spacing;
      if (values(result.image, "patch")[k] == 0.0F || depth_error > 2.0) {
        ++errors.holes;
        continue;
      }
      const glm::dvec3 seen(values(result.image, "N.X")[k], values(result.image, "N.Y")[k],
                            values(result.image, "N.Z")[k]);
      const double angle = std::asin(std::min(glm::length(glm::cross(seen, normal)), 1.0));
      errors.normal_degrees += angle * angle;
      errors.depth_cells += depth_error * depth_error;
    }
  }
  const auto count = static_cast<double>(errors.pixels);
  errors.normal_degrees = std::sqrt(errors.normal_degrees / count) * 180.0 / std::acos(-1.0);
  errors.depth_cells = std::sqrt(errors.depth_cells / count);
  return errors;
}

TEST_P(Surfaces, SphereOfManyPatchesHasNoHolesAndItsOwnNormals) {
  test::SphereShape shape;
  shape.centre = {3.0, -2.0, 1.0};
  shape.spacing = 0.05;
  const PatchModel model = test::sphere_model(shape);
  for (const double distance : {0.0, 1.6, 1.15}) {
    RenderSettings settings = small_image(model, {30.0, 20.0, distance});
    settings.primitive = GetParam().primitive;
    settings.interpolation = GetParam().interpolation;
    const SurfaceErrors errors = sphere_errors(shape, settings, model);
    EXPECT_GT(errors.pixels, 1000U);
    EXPECT_EQ(errors.holes, 0U) << distance;
    // A splat's plane is off the sphere by 0.0125 cells at its corner, a triangle by as much in its
    // middle. At 20 degrees that moves the position by 0.035 cells, over which the normal turns by
    // 0.1 degrees (a disc reaches further than a quad); the maps' bilinear normals and half floats
    // add little.
    EXPECT_LT(errors.normal_degrees, 0.2) << distance;
    EXPECT_LT(errors.depth_cells, 0.04) << distance;
  }
}

TEST_P(Surfaces, NoiseHasNoHoles) {
  // Uniform noise of +-0.3 cells on slopes up to 45 degrees is worse than any scan that was
  // smoothed by moving least squares. From above and from 40 degrees over the base plane the
  // image is full of surface, so that every pixel of background is a hole.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  PatchModel model = test::height_field(90, [&](double x, double y) {
    return 2.0 * std::sin(0.5 * x) * std::cos(0.4 * y) + noise(random);
  });
  model.patches[0].normals = {};  // those of the heights, not of noise that never stood anywhere
  for (const double elevation : {88.0, 60.0, 40.0}) {
    RenderSettings settings = small_image(model);
    const double e = elevation * std::acos(-1.0) / 180.0;
    settings.camera = {
        30.0 * glm::dvec3(0.0, -std::cos(e), std::sin(e)), {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
    settings.primitive = GetParam().primitive;
    settings.interpolation = GetParam().interpolation;
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height) << elevation;
  }
}

TEST_P(Surfaces, PlanesOfAnyTiltHaveNoHoles) {
  for (const double slope : {0.0, 0.5, 1.0, 2.2, 4.0}) {
    for (const double turn : {0.0, 0.3, 0.785}) {
      const PatchModel model = test::height_field(64, [&](double x, double y) {
        return slope * (std::cos(turn) * x + std::sin(turn) * y);
      });
      RenderSettings settings = small_image(model);
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(-slope * std::cos(turn), -slope * std::sin(turn), 1.0));
      // Near enough for cells of several pixels, then so far that there are many in a pixel.
      for (const double distance : {6.0, 3000.0}) {
        settings.camera = {distance * normal, {0.0, 0.0, 0.0}, {0.3, 1.0, 0.2}, 45.0};
        if (distance > 100.0) settings.camera.vertical_fov_degrees = 0.5;
        settings.primitive = GetParam().primitive;
        settings.interpolation = GetParam().interpolation;
        const RenderResult result = must_render(model, settings);
        EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height)
            << slope << " " << turn << " " << distance;
      }
    }
  }
}

TEST_P(Surfaces, PixelsSmallerThanSamplesHaveNoHoles) {
  test::SphereShape shape;
  shape.spacing = 0.02;
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = small_image(model, {50.0, -30.0}, 24);
  settings.primitive = GetParam().primitive;
  settings.interpolation = GetParam().interpolation;
  const SurfaceErrors errors = sphere_errors(shape, settings, model);
  EXPECT_EQ(errors.holes, 0U);
}

TEST_P(Surfaces, GeoreferencedCoordinatesGiveTheSameImage) {
  test::SphereShape shape;
  shape.coloured = true;
  const PatchModel near = test::sphere_model(shape);
  PatchModel far = near;
  const glm::dvec3 shift(5.0e5, 4.2e6, 1.0e7);
  for (Patch& patch : far.patches) patch.origin += shift;
  far.bounds = {near.bounds.min + shift, near.bounds.max + shift};
  RenderSettings settings = small_image(near, {20.0, 15.0, 1.3});
  settings.primitive = GetParam().primitive;
  settings.interpolation = GetParam().interpolation;
  const RenderResult one = must_render(near, settings);
  settings.camera.eye += shift;
  settings.camera.target += shift;
  const RenderResult other = must_render(far, settings);
  // Doubles at 1e7 are 2e-9 apart, 1e-7 of a pixel here: nothing but ties between splats may fall
  // the other way.
  EXPECT_LE(test::count_different(one.image, other.image, 1), 2U);
}

/// Where a ray first meets the triangles of a height field (grid coordinates), all cells halved
/// from (0, 0) to (1, 1).
std::optional<glm::dvec2> meet_triangles(const Patch& patch, glm::dvec3 eye, glm::dvec3 ray) {
  double nearest = std::numeric_limits<double>::max();
  std::optional<glm::dvec2> position;
  const auto node = [&patch](std::uint32_t i, std::uint32_t j) {
    return patch.origin + glm::dvec3(i, j, patch.at(i, j) * patch.height_step);
  };
  for (std::uint32_t j = 0; j + 1 < patch.height; ++j) {
    for (std::uint32_t i = 0; i + 1 < patch.width; ++i) {
      for (const bool lower : {false, true}) {
        const glm::dvec3 a = node(i, j);
        const glm::dvec3 ab = (lower ? node(i + 1, j) : node(i, j + 1)) - a;
        const glm::dvec3 ac = node(i + 1, j + 1) - a;
        const glm::dvec3 across = glm::cross(ray, ac);
        const double determinant = glm::dot(ab, across);
        const double u = glm::dot(eye - a, across) / determinant;
        const glm::dvec3 q = glm::cross(eye - a, ab);
        const double v = glm::dot(ray, q) / determinant;
        const double depth = glm::dot(ac, q) / determinant;
        if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && depth > 0.0 && depth < nearest)) continue;
        nearest = depth;
        position = glm::dvec2(eye + depth * ray - patch.origin);
      }
    }
  }
  return position;
}

TEST(Corrected, FollowsTheVirtualTrianglesAndDirectDoesNot) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  PatchModel model = test::height_field(20, [&](double x, double y) {
    return 1.5 * std::sin(0.5 * x) * std::cos(0.6 * y) + noise(random);
  });
  model.patches[0].normals = {};  // as above
  RenderSettings settings = small_image(model);
  settings.camera = {{12.0, -9.0, 22.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 30.0};
  settings.outputs.uv = true;
  const auto rms_cells = [&](Interpolation interpolation) {
    settings.interpolation = interpolation;
    const RenderResult result = must_render(model, settings);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t y = 0; y < settings.height; y += 3) {
      for (std::size_t x = 0; x < settings.width; x += 3) {
        const auto position =
            meet_triangles(model.patches[0], settings.camera.eye, pixel_ray(settings, x, y));
        if (!position) continue;
        const std::size_t k = y * settings.width + x;
        const glm::dvec2 uv(values(result.image, "UV.U")[k], values(result.image, "UV.V")[k]);
        sum += glm::dot(uv - *position, uv - *position);
        count += 1.0;
      }
    }
    EXPECT_GT(count, 300.0);
    return std::sqrt(sum / count);
  };
  const double direct = rms_cells(Interpolation::Direct);
  const double corrected = rms_cells(Interpolation::Corrected);
  EXPECT_LT(corrected, 0.4 * direct) << direct;
}

TEST_P(Surfaces, GrazingViewsHaveNoHoles) {
  // Waves seen at 4 degrees over the base plane, at 0 to 40 over their flanks: where the planes of
  // neighbours part by a twentieth of a cell, a ray can pass for most of a cell between them.
  const PatchModel model = test::height_field(
      60, [](double x, double y) { return 0.9 * std::sin(0.45 * x) * std::cos(0.4 * y); });
  RenderSettings settings = small_image(model);
  const double e = 4.0 * std::acos(-1.0) / 180.0;
  settings.camera = {60.0 * glm::dvec3(0.0, -std::cos(e), std::sin(e)), {}, {0.0, 0.0, 1.0}, 6.0};
  settings.primitive = GetParam().primitive;
  settings.interpolation = GetParam().interpolation;
  settings.outputs = test::all_outputs();
  const RenderResult result = must_render(model, settings);
  std::size_t inside = 0;
  std::size_t holes = 0;
  for (std::size_t y = 0; y < settings.height; y += 2) {
    for (std::size_t x = 0; x < settings.width; x += 2) {
      const auto meets = [&](std::size_t row) {
        return meet_triangles(model.patches[0], settings.camera.eye, pixel_ray(settings, x, row));
      };
      if (y == 0 || !meets(y) || !meets(y - 1) || !meets(y + 1)) continue;  // the rim may be off
      ++inside;
      holes += values(result.image, "patch")[y * settings.width + x] == 0.0F ? 1U : 0U;
    }
  }
  EXPECT_GT(inside, 1000U);
  EXPECT_EQ(holes, 0U);
}

TEST(Corrected, SplatsDoNotStickOutOfASkyline) {
  // A rough ridge along x in front of the sky. What passes the surface by kLargestMiss may show,
  // which is twice as much upward where the slope is 1.7, the steepest here.
  const auto ridge = [](double raised) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.4, 0.4);
    return test::height_field(40, [&random, noise, raised](double, double y) mutable {
      return raised + (6.0 + noise(random)) * std::exp(-y * y / 50.0);
    });
  };
  const PatchModel model = ridge(0.0);
  const PatchModel raised = ridge(2.0 * (shared::kLargestMiss + shared::kOnSurface));
  RenderSettings settings = small_image(model);
  settings.camera = {{1.0, -60.0, 5.0}, {1.0, 0.0, 5.0}, {0.0, 0.0, 1.0}, 10.0};
  settings.outputs = test::all_outputs();
  const auto spikes = [&](Primitive primitive, Interpolation interpolation) {
    settings.primitive = primitive;
    settings.interpolation = interpolation;
    const RenderResult result = must_render(model, settings);
    EXPECT_GT(result.covered_pixels, 1000U);
    std::size_t count = 0;
    for (std::size_t y = 0; y < settings.height / 2; ++y) {
      for (std::size_t x = 0; x < settings.width; x += 2) {
        if (values(result.image, "patch")[y * settings.width + x] == 0.0F) continue;
        const glm::dvec3 ray = pixel_ray(settings, x, y);
        count += meet_triangles(raised.patches[0], settings.camera.eye, ray) ? 0U : 1U;
      }
    }
    return count;
  };
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    EXPECT_EQ(spikes(primitive, Interpolation::Corrected), 0U);
    EXPECT_GT(spikes(primitive, Interpolation::Direct), 0U);
  }
  EXPECT_EQ(spikes(Primitive::Cell, Interpolation::Corrected), 0U);
}

TEST(Sprites, LargerThanThePointSizeLimitStayCentred) {
  // A cell is 400 pixels wide here; llvmpipe's sprites end at 255.
  const PatchModel model = test::height_field(16, [](double x, double y) { return 0.3 * x * y; });
  RenderSettings settings = small_image(model);
  settings.camera = {{0.1, 0.0, 0.2}, {0.4, 0.3, 0.0}, {0.0, 0.0, 1.0}, 60.0};
  settings.outputs = test::all_outputs();
  settings.primitive = Primitive::Quad;
  const RenderResult quads = must_render(model, settings);
  settings.primitive = Primitive::Sprite;
  const RenderResult sprites = must_render(model, settings);
  std::size_t different = 0;
  for (std::size_t k = 0; k < values(quads.image, "Z").size(); ++k) {
    const bool both = values(quads.image, "patch")[k] > 0 && values(sprites.image, "patch")[k] > 0;
    const double u = values(quads.image, "UV.U")[k] - values(sprites.image, "UV.U")[k];
    const double v = values(quads.image, "UV.V")[k] - values(sprites.image, "UV.V")[k];
    different += both && std::hypot(u, v) < 0.3 ? 0 : 1;
  }
  // Discs reach a little further than quads at the horizon and where the saddle bends away.
  EXPECT_LT(different, values(quads.image, "Z").size() / 20);
  EXPECT_GT(quads.covered_pixels, 3000U);
}

INSTANTIATE_TEST_SUITE_P(All, Surfaces, testing::ValuesIn(all_methods()),
                         [](const auto& method) { return std::string(method.param.name); });

}  // namespace
}  // namespace relief
