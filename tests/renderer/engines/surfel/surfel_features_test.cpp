// Curved surfels, textures, clip lines and mean surfels of the engine `surfel`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "common/image/srgb.h"
#include "renderer/engines/surfel/select_surfels.h"
#include "renderer/view/view.h"
#include "tests/renderer/engines/surfel/surfel_images.h"

namespace relief {
namespace {

using test::must_draw;
using test::pixel_ray;
using test::sphere_cloud;
using test::surfel_image;
using test::values;

/// Pixels that are covered although their rays miss the unit sphere, and those that are not
/// although they hit it.
struct SilhouetteError {
  std::size_t beyond = 0;
  std::size_t missing = 0;
};

SilhouetteError silhouette_error(const Image& image, const RenderSettings& settings) {
  SilhouetteError error;
  for (std::size_t k = 0; k < std::size_t{settings.width} * settings.height; ++k) {
    const glm::dvec3 ray =
        glm::normalize(pixel_ray(settings, k % settings.width, k / settings.width));
    const glm::dvec3 toward = -settings.camera.eye;
    const bool hit = glm::length(toward - glm::dot(toward, ray) * ray) < 1.0;
    const bool covered = values(image, "A")[k] > 0.0F;
    error.beyond += covered && !hit ? 1 : 0;
    error.missing += !covered && hit ? 1 : 0;
  }
  return error;
}

TEST(SurfelCurved, FollowsTheContour) {
  // 400 discs of radius 0.18: flat, they stick out by up to 0.016, 1.4 pixels.
  const SplatCloud cloud = sphere_cloud(400);
  RenderSettings settings = surfel_image({1.5, -2.0, 3.0}, 256);
  settings.count_fragments = true;
  settings.explain = false;
  settings.surfel.curved = SurfelCurved::None;
  const RenderResult plain = must_draw(cloud, settings);
  settings.surfel.curved = SurfelCurved::All;
  const RenderResult all = must_draw(cloud, settings);
  settings.surfel.curved = SurfelCurved::Auto;
  const RenderResult automatic = must_draw(cloud, settings);
  const SilhouetteError of_plain = silhouette_error(plain.image, settings);
  const SilhouetteError of_all = silhouette_error(all.image, settings);
  const SilhouetteError of_auto = silhouette_error(automatic.image, settings);
  EXPECT_GT(of_plain.beyond, 300U);
  EXPECT_LT(of_all.beyond, of_plain.beyond / 4);
  EXPECT_LT(of_auto.beyond, of_plain.beyond / 3);
  // Chords cut off what a bent surfel's triangles are off the sphere.
  EXPECT_LE(of_all.missing, 60U);
  EXPECT_LE(of_auto.missing, 60U);
}

TEST(SurfelCurved, AutomaticIsAtTheContourAlone) {
  const SplatCloud cloud = sphere_cloud(4000);
  RenderSettings settings = surfel_image({0.0, 0.0, 4.0}, 512);
  settings.explain = true;
  const auto draws = [&](SurfelCurved curved) {
    settings.surfel.curved = curved;
    const RenderResult result = must_draw(cloud, settings);
    std::vector<std::string> programs;
    for (const Explanation::Draw& draw : result.explanation->draws)
      programs.push_back(draw.program);
    return programs;
  };
  const auto has_curved = [](const std::vector<std::string>& programs) {
    return std::ranges::find(programs, "curved visibility") != programs.end();
  };
  EXPECT_FALSE(has_curved(draws(SurfelCurved::None)));
  EXPECT_TRUE(has_curved(draws(SurfelCurved::Auto)));
  // From afar a pixel does not see how far they bend.
  settings.camera.eye = {0.0, 0.0, 400.0};
  settings.pixels_per_sample = 0.0;
  EXPECT_FALSE(has_curved(draws(SurfelCurved::Auto)));
}

/// A square of points, `step` apart, with a texture whose red is `s` and whose green is `t`.
SplatCloud textured_plane(double step) {
  SplatCloud cloud;
  for (double y = -4.0; y <= 4.0; y += step) {
    for (double x = -4.0; x <= 4.0; x += step) {
      test::add_point(cloud, {x, y, 0.0}, {0.0F, 0.0F, 1.0F}, 1.2 * step);
      cloud.texcoords.emplace_back((x + 5.0) / 10.0, (5.0 - y) / 10.0);
    }
  }
  cloud.colours.clear();
  auto image = std::make_shared<Image>(Image{128, 128, {}});
  for (const char* const name : {"R", "G", "B"})
    image->channels.push_back({name, ChannelType::Float, std::vector<float>(128 * 128, 0.0F)});
  for (std::size_t k = 0; k < std::size_t{128} * 128; ++k) {
    image->channels[0].values[k] = (static_cast<float>(k % 128) + 0.5F) / 128.0F;
    image->channels[1].values[k] = (static_cast<float>(k / 128) + 0.5F) / 128.0F;
  }
  cloud.texture = image;
  return cloud;
}

TEST(SurfelTexture, FollowsItsCoordinatesWithinSurfels) {
  // Few surfels: a colour each would be off by half a step, 0.04.
  const SplatCloud cloud = textured_plane(0.8);
  for (const SurfelBlend blend : {SurfelBlend::Normalised, SurfelBlend::Sorted}) {
    RenderSettings settings = surfel_image({0.5, -2.0, 6.0});
    settings.surfel.blend = blend;
    const RenderResult result = must_draw(cloud, settings);
    std::size_t seen = 0;
    for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
      const glm::dvec3 ray = pixel_ray(settings, k % 96, k / 96);
      const glm::dvec3 hit = settings.camera.eye - settings.camera.eye.z / ray.z * ray;
      if (std::abs(hit.x) > 3.5 || std::abs(hit.y) > 3.5) continue;
      ++seen;
      // Eight bits of sRGB, in steps of up to 0.009 of linear light, and mip levels of a ramp.
      ASSERT_NEAR(values(result.image, "R")[k], (hit.x + 5.0) / 10.0, 0.012);
      ASSERT_NEAR(values(result.image, "G")[k], (5.0 - hit.y) / 10.0, 0.012);
    }
    EXPECT_GT(seen, 4000U);
  }
}

TEST(SurfelTexture, PointsWithoutCoordinatesHaveTheirColour) {
  SplatCloud cloud = textured_plane(0.2);
  cloud.colours.assign(cloud.positions.size(), {0.0F, 0.0F, 1.0F, 1.0F});
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    if (cloud.positions[k].x > 0.0) cloud.texcoords[k] = glm::vec2(std::nanf(""));
  }
  const RenderResult result = must_draw(cloud, surfel_image({0.0, 0.0, 6.0}));
  // Off the middle, where both sides blend: the texture has no blue, the colour nothing else.
  const std::size_t row = std::size_t{48} * 96;
  EXPECT_EQ(values(result.image, "B")[row + 30], 0.0F);
  EXPECT_GT(values(result.image, "R")[row + 30], 0.1F);
  EXPECT_EQ(values(result.image, "B")[row + 66], 1.0F);
  EXPECT_EQ(values(result.image, "R")[row + 66], 0.0F);
}

TEST(SurfelClip, EndsSurfelsAtTheEdge) {
  // A roof with its ridge along y, seen from above: the discs next to it, of radius 0.35, go on
  // beyond it, over the other side. The others are too small to reach it, or what is seen there.
  SplatCloud cloud;
  const double half = std::sqrt(0.5);
  for (double y = -4.0; y <= 4.0; y += 0.25) {
    for (double s = 0.1; s <= 4.0; s += 0.25) {
      for (const double side : {-1.0, 1.0}) {
        test::add_point(cloud, {side * s * half, y, -s * half},
                        {static_cast<float>(side * half), 0.0F, static_cast<float>(half)},
                        s < 0.2 ? 0.35 : 0.2);
      }
    }
  }
  RenderSettings settings = surfel_image({0.0, 0.0, 12.0});
  settings.camera.orthographic_height = 4.0;
  const auto wrong_depths = [&](const Image& image) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
      const double x = (static_cast<double>(k % 96) + 0.5) / 24.0 - 2.0;
      count += std::abs(values(image, "Z")[k] - (12.0 + std::abs(x))) > 0.01 ? 1 : 0;
    }
    return count;
  };
  for (const SurfelCurved curved : {SurfelCurved::None, SurfelCurved::All}) {
    settings.surfel.curved = curved;
    settings.clip.rule = ClipRule::Off;
    settings.outputs.clip = false;
    EXPECT_GT(wrong_depths(must_draw(cloud, settings).image), 500U);
    settings.clip.rule = ClipRule::Partners;
    settings.clip.threshold = 0.5;
    settings.outputs.clip = true;
    const RenderResult clipped = must_draw(cloud, settings);
    EXPECT_EQ(wrong_depths(clipped.image), 0U);
    EXPECT_EQ(clipped.covered_pixels, 96U * 96U);
    const std::vector<float>& kinds = values(clipped.image, "clip");
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const double x = (static_cast<double>(k % 96) + 0.5) / 24.0 - 2.0;
      const double s = std::abs(x) / half;
      if (s < 0.14) {
        ASSERT_EQ(kinds[k], 1.0F);
      } else if (s > 0.46) {
        ASSERT_EQ(kinds[k], 0.0F);
      }
    }
  }
}

TEST(SurfelClip, CostsNothingWithoutEdges) {
  const SplatCloud cloud = sphere_cloud(3000);
  RenderSettings settings = surfel_image({1.0, 2.0, 3.0});
  const RenderResult whole = must_draw(cloud, settings);
  settings.clip.rule = ClipRule::Partners;
  settings.clip.threshold = 0.8;
  settings.explain = true;
  const RenderResult clipped = must_draw(cloud, settings);
  EXPECT_TRUE(test::is_same(whole.image, clipped.image));
  for (const Explanation::Draw& draw : clipped.explanation->draws)
    EXPECT_EQ(draw.program.find("clipped"), std::string::npos) << draw.program;
}

TEST(SurfelSides, OfASlabDoNotBlend) {
  // Both lie within the depth of blending, a radius.
  for (const double toward : {1.0, -1.0}) {
    for (const bool sorted : {false, true}) {
      RenderSettings settings = surfel_image({0.0, 0.0, toward * 14.0});
      if (sorted) settings.surfel.blend = SurfelBlend::Sorted;
      const RenderResult result = must_draw(test::slab_cloud(), settings);
      std::size_t covered = 0;
      for (std::size_t k = 0; k < values(result.image, "A").size(); ++k) {
        if (!(values(result.image, "A")[k] > 0.0F)) continue;
        ++covered;
        // At its rim the other side sticks out.
        const float z = values(result.image, "N.Z")[k];
        EXPECT_NEAR(std::abs(z), 1.0F, 2e-3F) << "half floats";
        const std::size_t x = k % 96;
        const std::size_t y = k / 96;
        const bool is_inside = x > 24 && x < 72 && y > 24 && y < 72;
        EXPECT_TRUE(!is_inside || z * toward > 0.0);
      }
      EXPECT_GT(covered, 2304U);
    }
  }
}

TEST(SurfelSides, AreToldApartOnlyWhereBothAreDrawn) {
  RenderSettings settings = surfel_image({0.0, 0.0, 14.0});
  settings.explain = true;
  const auto tells = [&](CullMode cull) {
    settings.cull = cull;
    const RenderResult result = must_draw(test::slab_cloud(), settings);
    return std::ranges::any_of(
        result.explanation->textures,
        [](const Explanation::Memory& texture) { return texture.name == "sides"; });
  };
  EXPECT_TRUE(tells(CullMode::None));
  EXPECT_FALSE(tells(CullMode::Back));
}

TEST(SurfelLevels, MeansStandForSurfelsThatAreSmall) {
  const SplatCloud cloud = sphere_cloud(40000);
  RenderSettings settings = surfel_image({0.0, 0.0, 12.0});
  Progress silent;
  const auto set = surfel::make_surfel_set(cloud, settings.surfel, false, silent);
  ASSERT_TRUE(set);
  const View view = make_view(settings.camera, 96, 96, 1e-3);
  const auto count = [&](double pixels) {
    return select_surfels(*set, view, {.pixels_per_surfel = pixels}).list.size();
  };
  EXPECT_EQ(count(0.0), 40000U);
  // Both sides have 760 pixels, and nodes are up to four times smaller than one.
  EXPECT_LT(count(1.0), 20000U);
  settings.pixels_per_sample = 0.0;
  const RenderResult all = must_draw(cloud, settings);
  settings.pixels_per_sample = 1.0;
  const RenderResult fewer = must_draw(cloud, settings);
  // A mean surfel of a pixel's width moves the contour by a pixel at most, and its colour is the
  // mean: neighbouring pixels differ by 0.5 / 12.
  EXPECT_LT(test::count_different(all.image, fewer.image, 12), 60U);
}

}  // namespace
}  // namespace relief
