// Volumes and 3D Gaussians in a window's viewport.
#include <gtest/gtest.h>

#include "renderer/frame/attachments.h"
#include "renderer/frame/targets.h"
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
    const auto pixel = (*viewport)->probe(view, 30, 20);
    ASSERT_TRUE(pixel);
    EXPECT_EQ(values(*pixel, "patch")[0], 0.0F) << "nothing is picked";
  }
}

TEST(VolumeWindow, OtherEnginesOnTheCpuAreNone) {
  EXPECT_TRUE(is_for_viewports(*find_engine("onepass")));
  EXPECT_TRUE(is_for_viewports(*find_engine("volume-reference")));
  EXPECT_FALSE(is_for_viewports(*find_engine("raytrace")));
  EXPECT_FALSE(is_for_viewports(*find_engine("volume-truth")));
}

}  // namespace
}  // namespace relief::test
