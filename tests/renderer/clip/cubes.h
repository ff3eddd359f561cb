// A cube whose silhouette is known, for the tests of what clips splats.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/frame/gl_frame.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/view/view.h"
#include "tests/renderer/scenes.h"

namespace relief::test {

/// The six outward normals of a cube.
inline std::array<glm::dvec3, 6> cube_normals() {
  return {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

/// Axes along the edges of such a face, with its normal as the third.
inline glm::dmat3 face_axes(glm::dvec3 normal) {
  const glm::dvec3 u(std::abs(normal.z), std::abs(normal.x), std::abs(normal.y));
  return {u, glm::cross(normal, u), normal};
}

/// Points on the faces of the cube from -1 to 1, `side` of them a row, none on an edge. Each face
/// is brighter than the one before.
inline SplatCloud cube_cloud(int side) {
  SplatCloud cloud;
  const double spacing = 2.0 / side;
  float grey = 0.1F;
  for (const glm::dvec3& normal : cube_normals()) {
    const glm::dmat3 axes = face_axes(normal);
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const glm::dvec2 at = (glm::dvec2(i, j) + 0.5) * spacing - 1.0;
        cloud.positions.push_back(normal + at.x * axes[0] + at.y * axes[1]);
        cloud.normals.emplace_back(normal);
        cloud.radii.push_back(spacing);
        cloud.colours.emplace_back(grey, grey, grey, 1.0F);
      }
    }
    grey += 0.1F;
  }
  return cloud;
}

/// The same cube as six patches of `nodes` nodes a side, whose last samples are half a spacing from
/// the edges: their splats reach beyond.
inline PatchModel cube_patches(std::uint32_t nodes) {
  std::vector<Patch> patches;
  const double spacing = 2.0 / nodes;
  for (const glm::dvec3& normal : cube_normals()) {
    const glm::dmat3 axes = face_axes(normal);
    const glm::dvec3 corner = normal + (0.5 * spacing - 1.0) * (axes[0] + axes[1]);
    patches.push_back(sample_patch({corner, axes, spacing, nodes, nodes}, [normal](glm::dvec3) {
      return SurfacePoint{0.0, normal, {}};
    }));
  }
  return model_of(std::move(patches));
}

/// The silhouette of that cube: how many pixels a pixel's middle lies outside, below 0 inside, for
/// every pixel, the top row first. The hull of its corners in the image.
inline std::vector<double> outside_cube(const View& view) {
  std::vector<glm::dvec2> corners;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 world((k & 1) == 0 ? -1 : 1, (k & 2) == 0 ? -1 : 1, (k & 4) == 0 ? -1 : 1);
    const glm::dvec3 eye = view.rotation * (world - view.eye);
    const glm::dvec2 across = view.orthographic ? glm::dvec2(eye) : glm::dvec2(eye) / -eye.z;
    corners.emplace_back((across.x / view.slope_x + 1.0) * 0.5 * view.width,
                         (1.0 - across.y / view.slope_y) * 0.5 * view.height);
  }
  std::vector<double> outside;
  outside.reserve(std::size_t{view.width} * view.height);
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const glm::dvec2 middle(x + 0.5, y + 0.5);
      double most = -1e9;
      for (const glm::dvec2& a : corners) {
        for (const glm::dvec2& b : corners) {
          const glm::dvec2 along = b - a;
          if (glm::dot(along, along) < 1e-12) continue;
          const glm::dvec2 normal = glm::normalize(glm::dvec2(along.y, -along.x));
          const bool is_side =
              std::all_of(corners.begin(), corners.end(),
                          [&](const glm::dvec2& c) { return glm::dot(c - a, normal) < 1e-6; });
          if (is_side) most = std::max(most, glm::dot(middle - a, normal));
        }
      }
      outside.push_back(most);
    }
  }
  return outside;
}

/// What is wrong at the silhouette, in pixels.
struct SilhouetteErrors {
  std::size_t overhang = 0;  ///< covered by more than half, more than a pixel outside
  std::size_t holes = 0;     ///< covered by less than all, more than a pixel inside
  std::size_t moved = 0;     ///< the middle of the edge is more than a fifth of a pixel off
};

/// `all`: the coverage from which on a pixel is covered by all.
inline SilhouetteErrors silhouette_errors(const std::vector<float>& alpha, const View& view,
                                          float all = 1.0F) {
  const std::vector<double> outside = outside_cube(view);
  SilhouetteErrors errors;
  for (std::size_t k = 0; k < alpha.size(); ++k) {
    if (outside[k] > 1.0 && alpha[k] > 0.5F) ++errors.overhang;
    if (outside[k] < -1.0 && alpha[k] < all) ++errors.holes;
    if (std::abs(outside[k]) > 0.2 && (outside[k] > 0.0) == (alpha[k] > 0.5F)) ++errors.moved;
  }
  return errors;
}

}  // namespace relief::test
