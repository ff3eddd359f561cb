// Clip lines in the engine `multipass`: in both passes over the splats, and nothing where there is
// no edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/sample_discs.h"
#include "renderer/geometry/samples/samples.h"
#include "shaders/include/shared.h"
#include "tests/renderer/clip/cubes.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::values;

class MultipassClip : public testing::TestWithParam<Primitive> {
 protected:
  /// A cube, seen at an angle.
  static RenderSettings cube_image(ClipRule rule, bool orthographic = false) {
    RenderSettings settings;
    settings.engine = "multipass";
    settings.primitive = GetParam();
    settings.width = settings.height = 160;
    settings.camera = {{2.6, 1.9, 3.1}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
    if (orthographic) settings.camera.orthographic_height = 4.5;
    settings.background.reset();
    settings.debug = true;
    settings.outputs = {.normal = true, .depth = true, .clip = true};
    settings.clip.rule = rule;
    return settings;
  }
  static View view_of(const RenderSettings& settings) {
    return make_view(settings.camera, settings.width, settings.height, 1e-3);
  }
};

TEST_P(MultipassClip, ACubeHasTheSilhouetteOfACube) {
  const PatchModel model = test::cube_patches(8);
  for (const bool orthographic : {false, true}) {
    const auto errors = [&](ClipRule rule) {
      const RenderSettings settings = cube_image(rule, orthographic);
      return test::silhouette_errors(values(must_render(model, settings).image, "A"),
                                     view_of(settings));
    };
    // Splats reach half a spacing and more beyond the last samples, to the edge; those of the other
    // faces' planes, and discs, reach beyond it.
    EXPECT_EQ(errors(ClipRule::Partners).overhang, 0U);
    EXPECT_EQ(errors(ClipRule::Partners).holes, errors(ClipRule::Off).holes);
  }
}

TEST_P(MultipassClip, NormalsDoNotMixAtAnEdge) {
  const PatchModel model = test::cube_patches(8);
  const auto mixed = [&](ClipRule rule) {
    const Image image = must_render(model, cube_image(rule)).image;
    std::size_t count = 0;
    for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
      if (values(image, "A")[k] < 1.0F) continue;
      const float most =
          std::max({std::abs(values(image, "N.X")[k]), std::abs(values(image, "N.Y")[k]),
                    std::abs(values(image, "N.Z")[k])});
      if (most < 0.99F) ++count;
    }
    return count;
  };
  // Discs reach 0.9 spacings beyond each of three edges; clipped they end a hundredth of a spacing
  // beyond. What is left (310 pixels) is of faces that face away: splats of their second row reach
  // the edge with the faint rim of discs that no line bounds.
  EXPECT_LT(mixed(ClipRule::Partners), 400U);
  EXPECT_GT(mixed(ClipRule::Off), 10 * mixed(ClipRule::Partners));
}

TEST_P(MultipassClip, TheOutputSaysHowTheSplatInFrontIsClipped) {
  const PatchModel model = test::cube_patches(8);
  const Image off = must_render(model, cube_image(ClipRule::Off)).image;
  for (const float kind : values(off, "clip")) ASSERT_EQ(kind, 0.0F);
  const Image on = must_render(model, cube_image(ClipRule::Partners)).image;
  EXPECT_EQ(on.find("clip")->type, ChannelType::Uint);
  const std::vector<float>& kinds = values(on, "clip");
  const auto count = [&](ClipKind kind) {
    return std::count(kinds.begin(), kinds.end(), static_cast<float>(kind));
  };
  EXPECT_GT(count(ClipKind::None), 1000);  // the middles of the faces, and the background
  EXPECT_GT(count(ClipKind::Flat), 500);   // a row of splats beside each edge
}

TEST_P(MultipassClip, ASmoothModelIsDrawnAsItIs) {
  test::SphereShape shape;
  shape.spacing = 0.08;
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = test::small_image(model);
  settings.engine = "multipass";
  settings.primitive = GetParam();
  settings.outputs = {true, true, true, true};
  const RenderResult off = must_render(model, settings);
  settings.clip.rule = ClipRule::Partners;
  const RenderResult on = must_render(model, settings);
  EXPECT_EQ(on.fragments, off.fragments);
  for (const Channel& channel : off.image.channels)
    EXPECT_EQ(values(on.image, channel.name.c_str()), channel.values) << channel.name;
}

TEST_P(MultipassClip, APatchWithoutAnEdgeCostsNothing) {
  const PatchModel model = test::height_field(16, [](double, double) { return 0.0; });
  RenderSettings settings = test::from_above(model, 16);
  settings.engine = "multipass";
  settings.primitive = GetParam();
  settings.count_fragments = false;
  settings.explain = true;
  settings.clip.rule = ClipRule::Partners;
  const RenderResult result = must_render(model, settings);
  ASSERT_TRUE(result.explanation);
  ASSERT_FALSE(result.explanation->draws.empty());
  for (const Explanation::Draw& draw : result.explanation->draws)
    EXPECT_EQ(draw.program.find("clipped"), std::string::npos) << draw.program;
}

INSTANTIATE_TEST_SUITE_P(Primitives, MultipassClip,
                         testing::Values(Primitive::Quad, Primitive::Sprite),
                         [](const auto& tested) {
                           return tested.param == Primitive::Quad ? "Quad" : "Sprite";
                         });

TEST(SampleDiscs, AreTheSplatsThatAreDrawn) {
  const PatchModel model =
      test::height_field(12, [](double x, double y) { return 0.5 * x + 0.25 * y; });
  const Progress silent;
  const auto made = make_sample_discs(model, 0, 1, 2.0, silent);
  ASSERT_TRUE(made);
  const SplatDiscs& discs = made->discs;
  ASSERT_EQ(discs.centres.size(), count_samples(model));
  ASSERT_EQ(made->first, (std::vector<std::size_t>{0, count_samples(model)}));
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.5, -0.25, 1.0));
  const double cosine = normal.z;
  for (std::size_t k = 0; k < discs.centres.size(); ++k) {
    const glm::dvec3& p = discs.centres[k];
    // Heights have steps of a thousandth, slopes of a 127th of the steepest.
    EXPECT_NEAR(p.z, 0.5 * p.x + 0.25 * p.y, 1e-3);
    EXPECT_LT(glm::distance(discs.normals[k], normal), 0.01);
    const double of_paper = 2.0 * std::sqrt(0.5) / (0.1 + 0.9 * cosine);
    EXPECT_GE(discs.radii[k], 0.99 * of_paper);
    EXPECT_LE(discs.radii[k], 2.0 * of_paper);
  }
}

}  // namespace
}  // namespace relief
