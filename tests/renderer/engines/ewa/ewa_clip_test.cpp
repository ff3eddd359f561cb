// Clip lines in the engine `ewa`: where they end a splat in the image, and what that does to shapes
// with sharp edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/engines/ewa/clip_lines.h"
#include "renderer/engines/ewa/splatting.h"
#include "tests/renderer/clip/cubes.h"
#include "tests/renderer/engines/ewa/ewa_clouds.h"
#include "tests/renderer/images.h"

namespace relief::ewa {
namespace {

using test::ewa_image;
using test::must_splat;
using test::values;

constexpr PixelMapping kClipMapping{100.0, {50.0, 50.0}, false};

/// A plane that leans away from the eye, seen in strong perspective.
struct LeaningPlane {
  glm::dvec3 point{0.1, -0.2, 2.0};
  glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, 0.6, -0.8));
  glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1)));
  glm::dvec3 v = glm::cross(normal, u);
};

TEST(ImageLines, LieWhereRaysMeetTheLineInThePlane) {
  const LeaningPlane plane;
  const glm::dvec3 direction = glm::normalize(0.8 * plane.u - 0.6 * plane.v);
  const double offset = 0.3;
  for (const bool orthographic : {false, true}) {
    PixelMapping mapping = kClipMapping;
    mapping.orthographic = orthographic;
    const glm::dvec3 line = beyond_line(mapping, plane.point, plane.normal, direction, offset);
    const glm::dvec2 centre = pixel_of(mapping, plane.point);
    const glm::dvec3 along = glm::cross(plane.normal, direction);
    for (const double t : {-0.9, -0.3, 0.0, 0.5, 0.9}) {
      for (const double across : {offset - 0.05, offset, offset + 0.05}) {
        const glm::dvec3 place = plane.point + across * direction + t * along;
        const glm::dvec2 pixel = pixel_of(mapping, place) - centre;
        const double beyond =
            (line.x * pixel.x + line.y * pixel.y + line.z) / glm::length(glm::dvec2(line));
        // In pixels; 0.05 units are a few. An affine mapping is off by several pixels here.
        if (across == offset) {
          EXPECT_NEAR(beyond, 0.0, 1e-9);
        }
        if (across < offset) {
          EXPECT_LT(beyond, -1.0);
        }
        if (across > offset) {
          EXPECT_GT(beyond, 1.0);
        }
      }
    }
  }
}

TEST(ImageLines, KeepTheShareThatThePixelSeesBeforeThem) {
  // Of a splat that faces the eye at depth 1: its Gaussian times that of the pixel, summed over a
  // fine grid.
  const auto plane = map_tangent_plane(kClipMapping, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0});
  ASSERT_TRUE(plane);
  for (const double pixels : {0.1, 0.3, 6.0}) {  // the splat's radius in the image
    const double radius = pixels / kClipMapping.scale;
    const glm::dvec3 beyond =
        beyond_line(kClipMapping, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, 0.4 * radius);
    const ImageLine line = image_line(beyond, seen_splat(*plane, radius, EwaFilter::Ewa), true);
    for (const double x : {-0.5, 0.0, 0.3, 2.5}) {
      double before = 0.0;
      double all = 0.0;
      for (double at = -40.0; at < 40.0; at += 0.001) {
        const double weight =
            std::exp(-0.5 * (at * at / (pixels * pixels) + (x - at) * (x - at) / kPixelVariance));
        all += weight;
        if (at < 0.4 * pixels) before += weight;
      }
      // The grid's steps are a thousandth of a pixel.
      EXPECT_NEAR(line.kept({x, 3.0}), before / all, 0.01) << pixels << ' ' << x;
    }
  }
}

TEST(ImageLines, GroupsClipWhatIsBeyondAllOfTheirLines) {
  // Two lines with a right angle between them, as seen from far inside, outside and between.
  const ImageLine right{{10.0, 0.0, 0.0}, true};
  const ImageLine below{{0.0, 10.0, 0.0}, true};
  const std::vector<ImageLine> both{right, below};
  std::vector<ImageLine> intersected = both;
  intersected[0].ends_group = false;
  EXPECT_EQ(kept_share(both, {-1.0, -1.0}).share, 1.0);
  EXPECT_EQ(kept_share(both, {1.0, -1.0}).share, 0.0);
  EXPECT_EQ(kept_share(both, {1.0, 1.0}).share, 0.0);
  EXPECT_EQ(kept_share(intersected, {1.0, -1.0}).share, 1.0);
  EXPECT_EQ(kept_share(intersected, {1.0, 1.0}).share, 0.0);
}

RenderSettings cube_image(bool clipped) {
  RenderSettings settings = ewa_image({2.6, 1.9, 3.1}, 160);
  settings.clip.rule = clipped ? ClipRule::Partners : ClipRule::Off;
  settings.outputs.clip = true;
  return settings;
}

View view_of(const RenderSettings& settings) {
  return make_view(settings.camera, settings.width, settings.height, 1e-3);
}

TEST(EwaClip, ACubeHasTheSilhouetteOfACube) {
  for (const int side : {8, 20}) {
    const SplatCloud cloud = test::cube_cloud(side);
    const View view = view_of(cube_image(true));
    const auto errors = [&](bool clipped) {
      const RenderResult result = must_splat(cloud, cube_image(clipped));
      // A pixel's Gaussian leaves 0.03 % of it beyond an edge that is a pixel away.
      return test::silhouette_errors(values(result.image, "A"), view, 0.999F);
    };
    // Splats reach 1.4 spacings beyond the edges, about five pixels of twenty a row.
    EXPECT_GT(errors(false).overhang, 300U) << side;
    EXPECT_EQ(errors(true).overhang, 0U) << side;
    // Kernels end at the exponent 1: half-way between two of them at an edge little is left.
    EXPECT_LE(errors(true).holes, 5U) << side;
    EXPECT_LE(errors(true).moved, 5U) << side;
  }
}

TEST(EwaClip, FacesDoNotMixAtAnEdge) {
  // Unlit faces of grey 0.1 to 0.6, each its own. A pixel more than two off any edge shows one.
  const SplatCloud cloud = test::cube_cloud(8);
  const auto mixed = [&](bool clipped) {
    const RenderResult result = must_splat(cloud, cube_image(clipped));
    const std::vector<float>& grey = values(result.image, "R");
    const std::vector<float>& alpha = values(result.image, "A");
    return std::count_if(grey.begin(), grey.end(), [&, k = std::size_t{0}](float g) mutable {
      const float tenths = 10.0F * g;
      return alpha[k++] == 1.0F && std::abs(tenths - std::round(tenths)) > 0.1F;
    });
  };
  // Three edges of about 60 pixels. The low-pass filter mixes two pixels to both sides (832 in
  // all), unclipped splats 1.4 spacings, a dozen pixels, to both sides.
  EXPECT_LT(mixed(true), 900);
  EXPECT_GT(mixed(false), 3 * mixed(true));
}

TEST(EwaClip, TheOutputSaysHowTheSplatInFrontIsClipped) {
  const SplatCloud cloud = test::cube_cloud(8);
  const RenderResult off = must_splat(cloud, cube_image(false));
  const std::vector<float>& nothing = values(off.image, "clip");
  EXPECT_EQ(std::count(nothing.begin(), nothing.end(), 0.0F),
            static_cast<std::ptrdiff_t>(nothing.size()));
  const RenderResult on = must_splat(cloud, cube_image(true));
  EXPECT_EQ(on.image.find("clip")->type, ChannelType::Uint);
  const std::vector<float>& kinds = values(on.image, "clip");
  const auto has = [&](ClipKind kind) {
    return std::count(kinds.begin(), kinds.end(), static_cast<float>(kind)) > 0;
  };
  EXPECT_TRUE(has(ClipKind::None));  // the middles of the faces
  EXPECT_TRUE(has(ClipKind::Flat));  // the edges
  EXPECT_LE(*std::max_element(kinds.begin(), kinds.end()), static_cast<float>(ClipKind::Mixed));
}

TEST(EwaClip, ASmoothSphereIsDrawnAsItIs) {
  const SplatCloud cloud = test::sphere_cloud(3000);
  RenderSettings settings = ewa_image({0.0, 0.0, 3.7});
  const RenderResult off = must_splat(cloud, settings);
  settings.clip.rule = ClipRule::Partners;
  const RenderResult on = must_splat(cloud, settings);
  for (const char* const name : {"R", "A", "N.X", "Z"})
    EXPECT_EQ(values(off.image, name), values(on.image, name)) << name;
}

/// A large splat before a plane, both across the view axis.
SplatCloud splat_before_plane() {
  SplatCloud cloud;
  test::add_point(cloud, {0.0, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 4.0, {1.0F, 0.0F, 0.0F, 1.0F});
  test::append(cloud, test::plane_cloud(20, 20, -3.0, {0.0F, 1.0F, 0.0F, 1.0F}));
  return cloud;
}

TEST(EwaClip, WhatIsBehindTheCutShows) {
  const SplatCloud cloud = splat_before_plane();
  // Clips what of the splat is to the right.
  ClipPartners partners;
  partners.first.assign(cloud.positions.size() + 1, 1);
  partners.first[0] = 0;
  partners.lines = {{{1.0F, 0.0F, 0.0F}, 0.0F, 1, true}};
  partners.kinds.assign(cloud.positions.size(), ClipKind::None);
  partners.kinds[0] = ClipKind::Flat;
  const RenderSettings settings = ewa_image({0.0, 0.0, test::distance_for(8.0)});
  EnvironmentCache environments;
  const auto lighting = make_lighting(settings, view_of(settings), environments);
  ASSERT_TRUE(lighting);
  const Progress silent;
  for (const int layers : {1, 4}) {
    for (const EwaFilter filter :
         {EwaFilter::Ewa, EwaFilter::SourceSpace, EwaFilter::Circular, EwaFilter::Unfiltered}) {
      EwaSettings ewa;
      ewa.layers = layers;
      ewa.filter = filter;
      ewa.coverage_threshold = 0.05;  // one splat alone covers
      const Splatted splatted = splat_cloud(cloud, view_of(settings), ewa, *lighting, silent,
                                            {&partners, ClipRule::Partners});
      const auto at = [&](std::uint32_t x) {
        return splatted.film.pixels[48 * splatted.film.width + x];
      };
      EXPECT_GT(at(44).colour.r, 0.5F);
      EXPECT_EQ(at(44).clip, static_cast<std::uint8_t>(ClipKind::Flat));
      EXPECT_EQ(at(54).colour.r, 0.0F);
      EXPECT_GT(at(54).colour.g, 0.5F);
      EXPECT_EQ(at(54).clip, 0);
      EXPECT_NEAR(at(54).depth, at(90).depth, 1e-3);
    }
  }
}

TEST(EwaClip, LevelsAreClippedToo) {
  const SplatCloud cloud = test::cube_cloud(40);
  RenderSettings settings = cube_image(true);
  // From so far that a spacing is a pixel: coarser sets are drawn first, and no time is left.
  settings.camera.eye *= 4.0;
  settings.ewa.time_budget_ms = 1e-9;
  const RenderResult result = must_splat(cloud, settings);
  ASSERT_GT(*result.level, 0U);
  EXPECT_EQ(test::silhouette_errors(values(result.image, "A"), view_of(settings)).overhang, 0U);
}

}  // namespace
}  // namespace relief::ewa
