// Clouds of points with known surfaces, for the tests of the engine `ewa`.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/render.h"

namespace relief::test {

inline void add_point(SplatCloud& cloud, glm::dvec3 position, glm::vec3 normal, double radius,
                      glm::vec4 colour = glm::vec4(0.5F, 0.5F, 0.5F, 1.0F)) {
  cloud.positions.push_back(position);
  cloud.normals.push_back(normal);
  cloud.radii.push_back(radius);
  cloud.colours.push_back(colour);
}

/// Points at whole coordinates of the plane z = `height`, x from -half to `right`, y from -half to
/// half; radius 1.
inline SplatCloud plane_cloud(int half, int right, double height = 0.0,
                              glm::vec4 colour = glm::vec4(0.5F, 0.5F, 0.5F, 1.0F)) {
  SplatCloud cloud;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= right; ++x)
      add_point(cloud, {x, y, height}, {0.0F, 0.0F, 1.0F}, 1.0, colour);
  }
  return cloud;
}

/// A unit sphere of points in a spiral, each of which stands for as much of it.
inline SplatCloud sphere_cloud(int points) {
  SplatCloud cloud;
  const double pi = std::numbers::pi;
  for (int k = 0; k < points; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / points;
    const double angle = k * pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const glm::dvec3 p(r * std::cos(angle), r * std::sin(angle), z);
    add_point(cloud, p, glm::vec3(p), std::sqrt(4.0 * pi / points),
              glm::vec4(glm::vec3(0.5) + 0.5F * glm::vec3(p), 1.0F));
  }
  return cloud;
}

/// A slab of half a spacing: the plane z = 0.25, and its back, whose points lie between those of
/// the front.
inline SplatCloud slab_cloud() {
  SplatCloud cloud = plane_cloud(6, 6, 0.25);
  for (int k = 0; k < 144; ++k)
    add_point(cloud, {k % 12 - 5.5, k / 12 - 5.5, -0.25}, {0.0F, 0.0F, -1.0F}, 1.0);
  return cloud;
}

inline void append(SplatCloud& to, const SplatCloud& from) {
  for (std::size_t k = 0; k < from.positions.size(); ++k)
    add_point(to, from.positions[k], from.normals[k], from.radii[k], from.colours[k]);
}

/// A square image with all outputs, unlit, transparent where nothing is, seen from `eye` toward
/// the origin.
inline RenderSettings ewa_image(glm::dvec3 eye, std::uint32_t side = 96) {
  RenderSettings settings;
  settings.engine = "ewa";
  settings.width = settings.height = side;
  settings.camera = {eye, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
  settings.material = Material::Unlit;
  settings.background.reset();
  settings.outputs = {true, true, true, true};
  settings.frames = 1;
  return settings;
}

/// How far away an eye over the origin sees one unit as `pixels` of such an image.
inline double distance_for(double pixels, std::uint32_t side = 96) {
  return side / (2.0 * pixels * std::tan(std::numbers::pi / 9.0));
}

inline RenderResult must_splat(const SplatCloud& cloud, const RenderSettings& settings) {
  Progress silent;
  auto result = render(cloud, settings, silent);
  if (result) return *result;
  ADD_FAILURE() << result.error().message;
  return {};
}

}  // namespace relief::test
