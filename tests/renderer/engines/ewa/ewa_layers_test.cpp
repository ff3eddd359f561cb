// The layered frame buffer of the engine `ewa`, against values computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "renderer/engines/ewa/layered_buffer.h"

namespace relief::ewa {
namespace {

constexpr double kTau = 0.4;

SplatAttributes coloured(glm::dvec3 colour, double alpha) {
  SplatAttributes attributes;
  attributes.colour = {colour, alpha};
  attributes.normal = {0.0, 0.0, 1.0};
  attributes.patch = 1;
  return attributes;
}

/// A contribution that covers a pixel by itself.
Contribution whole(double depth) {
  return {1.0, depth, 0.1};
}

glm::dvec3 albedo_of(const Surface& surface) {
  return surface.albedo;
}

const glm::dvec3 kRed(1.0, 0.0, 0.0);
const glm::dvec3 kGreen(0.0, 1.0, 0.0);
const glm::dvec3 kBlue(0.0, 0.0, 1.0);

/// Sums of a few products of halves are exact in binary.
void expect_colour(glm::dvec4 colour, glm::dvec4 expected) {
  EXPECT_EQ(colour, expected) << colour.r << ' ' << colour.g << ' ' << colour.b << ' ' << colour.a;
}

// What clip lines keep of a pixel is a part of it, not a thinner surface.
TEST(Fragments, CoverWhatTheirLinesKeep) {
  Fragment contour;
  contour.add({0.3, 2.0, 0.1, 0.9, {1.0, 0.0}}, {});
  contour.add({0.2, 2.0, 0.1, 0.6, {2.0, 0.1}}, {});
  EXPECT_NEAR(contour.coverage(kTau), 0.25, 1e-12);
  EXPECT_FALSE(contour.hides(kTau));
  // The other face of an edge keeps the rest.
  contour.add({0.9, 2.0, 0.1, 0.3, {-1.0, 0.0}}, {});
  EXPECT_NEAR(contour.coverage(kTau), 1.0, 1e-12);
}

TEST(Fragments, OfAnEdgeLieBesideAndOfAContourBehind) {
  const glm::dvec4 red{0.25, 0.0, 0.0, 0.25};
  expect_colour(blend_beside(red, {0.0, 0.5, 0.0, 0.5}), {0.25, 0.5, 0.0, 0.75});
  expect_colour(blend_beside(red, {0.0, 1.0, 0.0, 1.0}), {0.25, 0.75, 0.0, 1.0});
  expect_colour(blend_behind(red, {0.0, 0.25, 0.0, 0.25}), red);
  expect_colour(blend_behind(red, {0.0, 0.5, 0.0, 0.5}), {0.25, 0.25, 0.0, 0.5});
}

TEST(LayeredBuffer, BlendsTwoFragmentsByEquation12) {
  // co = cf af + cb ab (1 - af), ao = af + ab (1 - af).
  expect_colour(blend_over({0.5, 0.0, 0.0, 0.5}, {0.0, 0.5, 0.0, 0.5}), {0.5, 0.25, 0.0, 0.75});
  for (const bool front_first : {true, false}) {
    LayeredBuffer buffer(1, 1, 4, kTau, albedo_of);
    if (front_first) buffer.add(0, whole(1.0), coloured(kRed, 0.5));
    buffer.add(0, whole(2.0), coloured(kGreen, 0.5));
    if (!front_first) buffer.add(0, whole(1.0), coloured(kRed, 0.5));
    const ResolvedPixel pixel = buffer.resolve(0);
    expect_colour(pixel.colour, {0.5, 0.25, 0.0, 0.75});
    EXPECT_EQ(pixel.depth, 1.0);
  }
}

TEST(LayeredBuffer, MergesTheTwoClosestInDepth) {
  // Red at 1, green at 2, blue at 2.5, two layers: green and blue merge, and nothing is lost.
  LayeredBuffer buffer(1, 1, 2, kTau, albedo_of);
  buffer.add(0, whole(2.0), coloured(kGreen, 0.5));
  buffer.add(0, whole(1.0), coloured(kRed, 0.5));
  buffer.add(0, whole(2.5), coloured(kBlue, 0.5));
  expect_colour(buffer.resolve(0).colour, {0.5, 0.25, 0.125, 0.875});
}

TEST(LayeredBuffer, ASurfaceBetweenTwoMergedOnesIsBehindBoth) {
  // Red at 1 and green at 2 merge when blue at 5 comes; white at 1.5 comes too late to lie between.
  // Then white (1.5) and the merged one (at red's depth) are the closest two.
  LayeredBuffer buffer(1, 1, 2, kTau, albedo_of);
  buffer.add(0, whole(1.0), coloured(kRed, 0.5));
  buffer.add(0, whole(2.0), coloured(kGreen, 0.5));
  buffer.add(0, whole(5.0), coloured(kBlue, 1.0));
  buffer.add(0, whole(1.5), coloured(glm::dvec3(1.0), 0.5));
  // red 1/2 + green 1/4 + white 1/8 + blue 1/8.
  expect_colour(buffer.resolve(0).colour, {0.625, 0.375, 0.25, 1.0});
}

TEST(LayeredBuffer, EachFragmentIsShadedOnce) {
  int shaded = 0;
  LayeredBuffer buffer(1, 1, 2, kTau, [&shaded](const Surface& surface) {
    ++shaded;
    return surface.albedo;
  });
  for (int k = 0; k < 6; ++k) buffer.add(0, whole(1.0 + k), coloured(kRed, 0.5));
  (void)buffer.resolve(0);
  EXPECT_EQ(shaded, 6);
}

TEST(LayeredBuffer, OneLayerKeepsTheFrontSurface) {
  for (const bool front_first : {true, false}) {
    LayeredBuffer buffer(1, 1, 1, kTau, albedo_of);
    if (front_first) buffer.add(0, whole(1.0), coloured(kRed, 0.5));
    buffer.add(0, whole(2.0), coloured(kGreen, 1.0));
    if (!front_first) buffer.add(0, whole(1.0), coloured(kRed, 0.5));
    expect_colour(buffer.resolve(0).colour, {0.5, 0.0, 0.0, 0.5});
  }
}

TEST(LayeredBuffer, AccumulatesWithinTheThresholdAndSeparatesBeyond) {
  LayeredBuffer buffer(2, 1, 4, kTau, albedo_of);
  for (const std::size_t pixel : {0, 1}) {
    buffer.add(pixel, {0.25, 1.0, 0.1}, coloured(kRed, 0.5));
    buffer.add(pixel, {0.25, pixel == 0 ? 1.05 : 1.15, 0.1}, coloured(kRed, 0.5));
  }
  // One surface: q = 0.5 covers the pixel. Two: each covers 0.25 / 0.4 = 5/8, alpha 5/16.
  EXPECT_NEAR(buffer.resolve(0).colour.a, 0.5, 1e-15);
  EXPECT_NEAR(buffer.resolve(1).colour.a, 1.0 - 121.0 / 256.0, 1e-15);
}

TEST(LayeredBuffer, HiddenSurfacesTakeNoLayer) {
  // Behind an opaque surface that covers the pixel come and go five more; the one before it, seen
  // through, keeps its layer.
  LayeredBuffer buffer(1, 1, 2, kTau, albedo_of);
  buffer.add(0, whole(9.0), coloured(kBlue, 1.0));
  buffer.add(0, whole(8.0), coloured(kBlue, 1.0));
  buffer.add(0, whole(3.0), coloured(kGreen, 1.0));
  buffer.add(0, whole(1.0), coloured(kRed, 0.5));
  for (int k = 0; k < 5; ++k) buffer.add(0, whole(4.0 + k), coloured(kBlue, 1.0));
  buffer.add(0, whole(3.05), coloured(kGreen, 1.0));
  expect_colour(buffer.resolve(0).colour, {0.5, 0.5, 0.0, 1.0});
}

TEST(LayeredBuffer, ConstantTextureStaysConstant) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(1e-6, 1.0);
  LayeredBuffer buffer(1, 1, 4, kTau, albedo_of);
  const glm::dvec3 colour(0.1, 0.7, 1.0 / 3.0);
  SplatAttributes attributes = coloured(colour, 1.0);
  attributes.normal = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
  attributes.uv = {12.5, 7.25};
  for (int k = 0; k < 10000; ++k) buffer.add(0, {weight(random), 3.0, 0.1}, attributes);
  const ResolvedPixel pixel = buffer.resolve(0);
  // 10,000 additions may each round by 1.1e-16 of the sum; at random that is 1e-14.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(pixel.colour[c], colour[c], 1e-12);
    EXPECT_NEAR(pixel.normal[c], attributes.normal[c], 1e-12);
  }
  EXPECT_EQ(pixel.colour.a, 1.0);
  EXPECT_NEAR(pixel.depth, 3.0, 1e-12);
  EXPECT_NEAR(pixel.uv.x, 12.5, 1e-11);
}

TEST(LayeredBuffer, PatchAndCoordinatesAreOfTheLargestContribution) {
  LayeredBuffer buffer(1, 1, 4, kTau, albedo_of);
  SplatAttributes left = coloured(kRed, 1.0);
  left.uv = {10.0, 10.0};
  SplatAttributes right = left;
  right.patch = 2;
  right.uv = {2.0, 4.0};
  buffer.add(0, {0.2, 1.0, 0.1}, left);
  buffer.add(0, {0.5, 1.0, 0.1}, right);
  buffer.add(0, {0.1, 1.0, 0.1}, left);
  right.uv = {5.0, 4.0};
  buffer.add(0, {0.25, 1.0, 0.1}, right);
  const ResolvedPixel pixel = buffer.resolve(0);
  EXPECT_EQ(pixel.patch, 2U);
  EXPECT_NEAR(pixel.uv.x, 3.0, 1e-15);
  EXPECT_NEAR(pixel.uv.y, 4.0, 1e-15);
}

TEST(LayeredBuffer, AttributesAreOfTheSurfaceThatIsSeen) {
  // A stray contribution that covers a hundredth of the pixel lies before the surface.
  LayeredBuffer buffer(1, 1, 4, kTau, albedo_of);
  buffer.add(0, {0.004, 1.0, 0.1}, coloured(kRed, 1.0));
  SplatAttributes surface = coloured(kGreen, 1.0);
  surface.patch = 9;
  buffer.add(0, whole(2.0), surface);
  const ResolvedPixel pixel = buffer.resolve(0);
  EXPECT_EQ(pixel.patch, 9U);
  EXPECT_EQ(pixel.depth, 2.0);
  EXPECT_NEAR(pixel.colour.r, 0.01, 1e-15);
}

TEST(LayeredBuffer, NormalsChangeToTheNeighbourOfTheSameSurface) {
  // Three pixels: normals turn by 0.1 and 0.2 radians; the last has another surface before, which
  // is nobody's neighbour.
  std::vector<Surface> surfaces(3);
  LayeredBuffer buffer(3, 1, 4, kTau, [&surfaces](const Surface& surface) {
    if (surface.albedo == kGreen) surfaces[surface.pixel] = surface;
    return surface.albedo;
  });
  const double angles[] = {0.0, 0.1, 0.3};
  for (std::size_t k = 0; k < 3; ++k) {
    SplatAttributes attributes = coloured(kGreen, 0.5);
    attributes.normal = {std::sin(angles[k]), 0.0, std::cos(angles[k])};
    buffer.add(k, whole(5.0), attributes);
  }
  SplatAttributes other = coloured(kRed, 0.5);
  other.normal = {1.0, 0.0, 0.0};
  buffer.add(2, whole(1.0), other);
  for (std::size_t k = 0; k < 3; ++k) (void)buffer.resolve(k);
  // The chord of an angle a is 2 sin(a / 2); doubles.
  const double chords[3][2] = {{0.0, 2.0 * std::sin(0.05)},
                               {2.0 * std::sin(0.05), 2.0 * std::sin(0.1)},
                               {2.0 * std::sin(0.1), 0.0}};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(glm::length(surfaces[k].changes[0]), chords[k][0], 1e-14);
    EXPECT_NEAR(glm::length(surfaces[k].changes[1]), chords[k][1], 1e-14);
    EXPECT_EQ(surfaces[k].changes[3], glm::dvec3(0.0));
  }
  EXPECT_LT(surfaces[1].changes[0].x, 0.0);
  EXPECT_GT(surfaces[1].changes[1].x, 0.0);
}

TEST(LayeredBuffer, NormalsThatCancelOutAreZero) {
  LayeredBuffer buffer(2, 1, 4, kTau, albedo_of);
  SplatAttributes a = coloured(kRed, 1.0);
  buffer.add(0, whole(1.0), a);
  a.normal = -a.normal;
  buffer.add(0, whole(1.0), a);
  EXPECT_EQ(buffer.resolve(0).normal, glm::dvec3(0.0));
  expect_colour(buffer.resolve(1).colour, glm::dvec4(0.0));
}

}  // namespace
}  // namespace relief::ewa
