// Volumes and 3D Gaussians in a window's viewport.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/render.h"
#include "renderer/viewport.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief::test {
namespace {

VolumeParts two_gaussians() {
  GaussianCloud cloud;
  cloud.centres = {{0.0F, 0.0F, 3.0F}, {2.0F, 1.0F, -1.0F}};
  cloud.scales.assign(2, glm::vec3(1.5F));
  cloud.rotations.assign(2, glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
  cloud.opacities = {0.7F, 0.9F};
  cloud.harmonics = {glm::vec3(0.8F, -0.5F, 0.3F), glm::vec3(-0.4F, 0.9F, 0.0F)};
  VolumeParts parts;
  parts.list.push_back({std::move(cloud)});
  return parts;
}

TEST(VolumeWindow, ShowsWhatRenderDraws) {
  const PatchModel plane = height_field(11, [](double, double) { return 0.0; });
  const VolumeParts parts = two_gaussians();
  RenderModel model = RenderModel::of(plane);
  model.add(parts);
  for (const char* const engine : {"volume", "volume-reference"}) {
    RenderSettings view;
    view.engine = engine;
    view.width = 60;
    view.height = 40;
    view.camera.eye = {3.0, 2.0, 14.0};
    view.background.reset();
    Progress silent;
    const auto rendered = render(model, view, silent);
    ASSERT_TRUE(rendered) << rendered.error().message;

    const OwnContext window;
    const Gl& gl = window.gl();
    const auto viewport = Viewport::create(window.loader(), model, {&view, 1});
    ASSERT_TRUE(viewport) << viewport.error().message;
    EXPECT_FALSE((*viewport)->draws_parts(view));
    const Texture colour = make_attachment(gl, "window", GL_RGBA16F, view.width, view.height);
    const Framebuffer into = make_framebuffer(gl, "window", nullptr, {{0, &colour}});
    const std::array<GLfloat, 4> before{0.25F, 0.25F, 0.25F, 0.25F};
    gl.ClearNamedFramebufferfv(into.id(), GL_COLOR, 0, before.data());
    // Its lower left quarter.
    const Status drawn = (*viewport)->draw(view, {0, 0, 30, 20}, into.id());
    ASSERT_TRUE(drawn) << drawn.error().message;
    const Image shown = read_colour(gl, colour, view.width, view.height);
    for (const char* const channel : {"R", "G", "B", "A"}) {
      const auto& a = values(shown, channel);
      const auto& b = values(rendered->image, channel);
      for (std::size_t k = 0; k < a.size(); ++k) {
        const bool is_part = k / 60 >= 20 && k % 60 < 30;
        // Half floats of at most 1.
        ASSERT_NEAR(a[k], is_part ? b[k] : 0.25F, 0x1p-11F) << engine << ' ' << channel << ' ' << k;
      }
    }
  }
}

/// A ball that is opaque in its middle.
ScalarVolume ball() {
  ScalarVolume volume;
  volume.size = {20, 20, 20};
  volume.placement = RegularGrid{glm::dvec3(-3.0), glm::dmat3(6.0 / 19.0)};
  for (int n = 0; n < 20 * 20 * 20; ++n) {
    const glm::dvec3 node(n % 20, n / 20 % 20, n / 400);
    const double distance = glm::length(6.0 / 19.0 * node - 3.0);
    volume.values.push_back(static_cast<float>(std::max(100.0 * (1.0 - distance / 2.5), 0.0)));
  }
  return volume;
}

/// Pixels that are probed show what is in the image.
void expect_probed_as_drawn(const RenderModel& model) {
  RenderSettings view;
  view.engine = "volume";
  view.width = 60;
  view.height = 40;
  view.camera.eye = {3.0, 2.0, 14.0};
  view.outputs.depth = true;
  view.outputs.patch_id = true;
  Progress silent;
  const auto rendered = render(model, view, silent);
  ASSERT_TRUE(rendered) << rendered.error().message;
  const OwnContext window;
  const auto viewport = Viewport::create(window.loader(), model, {&view, 1});
  ASSERT_TRUE(viewport) << viewport.error().message;
  int kernels = 0;
  for (std::uint32_t y = 0; y < view.height; y += 3) {
    for (std::uint32_t x = 0; x < view.width; x += 3) {
      const auto pixel = (*viewport)->probe(view, x, y);
      ASSERT_TRUE(pixel) << pixel.error().message;
      const std::size_t k = (view.height - 1 - y) * view.width + x;
      const float depth = values(rendered->image, "Z")[k];
      EXPECT_EQ(values(*pixel, "patch")[0], values(rendered->image, "patch")[k]);
      if (std::isfinite(depth))
        EXPECT_NEAR(values(*pixel, "Z")[0], depth, 1e-4F * depth) << x << ' ' << y;
      else
        EXPECT_EQ(values(*pixel, "Z")[0], depth);
      kernels += std::isfinite(depth) && values(rendered->image, "patch")[k] == 0.0F ? 1 : 0;
    }
  }
  EXPECT_GT(kernels, 5) << "the test shows something";
}

TEST(VolumeWindow, KernelsAreProbedWhereTheyHideHalf) {
  const PatchModel plane = height_field(11, [](double, double) { return 0.0; });
  const VolumeParts gaussians = two_gaussians();
  const ScalarVolume volume = ball();
  RenderModel model;
  model.add(gaussians);
  expect_probed_as_drawn(model);
  RenderModel grid;
  grid.add(volume);
  expect_probed_as_drawn(grid);
  RenderModel among = RenderModel::of(plane);
  among.add(gaussians);
  expect_probed_as_drawn(among);
}

TEST(VolumeWindow, OtherEnginesOnTheCpuAreNone) {
  EXPECT_TRUE(is_for_viewports(*find_engine("onepass")));
  EXPECT_TRUE(is_for_viewports(*find_engine("volume-reference")));
  EXPECT_FALSE(is_for_viewports(*find_engine("raytrace")));
  EXPECT_FALSE(is_for_viewports(*find_engine("volume-truth")));
}

}  // namespace
}  // namespace relief::test
