// Which pieces of a surface show a view nothing but their back sides.
#include "renderer/geometry/cells/facing.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "common/scene/camera.h"

namespace relief {
namespace {

/// A bumpy piece of a patch of 8 by 8 cells that stands anywhere in the world.
struct Piece {
  std::vector<std::array<glm::dvec3, 3>> triangles;  ///< world, counterclockwise from the front
  NormalBounds normals;
  glm::dmat3 axes{1.0};
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

Piece bumpy_piece(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Piece piece;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(number(random), number(random), 1.5));
  piece.axes = glm::dmat3(glm::rotate(glm::dmat4(1.0), 3.0 * number(random), axis));
  const glm::dvec3 origin = 20.0 * glm::dvec3(number(random), number(random), number(random));
  std::array<std::array<double, 9>, 9> heights{};
  for (auto& row : heights) {
    for (double& height : row) height = 0.3 * number(random);
  }
  const auto node = [&](std::size_t i, std::size_t j) { return glm::dvec3(i, j, heights[j][i]); };
  const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    piece.normals.add(glm::vec3(glm::cross(b - a, c - a)));
    piece.triangles.push_back(
        {origin + piece.axes * a, origin + piece.axes * b, origin + piece.axes * c});
  };
  for (std::size_t j = 0; j < 8; ++j) {
    for (std::size_t i = 0; i < 8; ++i) {
      add(node(i, j), node(i + 1, j), node(i + 1, j + 1));
      add(node(i, j), node(i + 1, j + 1), node(i, j + 1));
    }
  }
  piece.centre = origin + piece.axes * glm::dvec3(4.0, 4.0, 0.0);
  piece.radius = glm::length(glm::dvec3(4.0, 4.0, 0.3));
  return piece;
}

bool shows_a_front(const View& view, const Piece& piece) {
  const glm::dvec3 backward = glm::transpose(view.rotation)[2];
  for (const auto& [a, b, c] : piece.triangles) {
    const glm::dvec3 to_eye = view.orthographic ? backward : view.eye - a;
    if (glm::dot(glm::cross(b - a, c - a), to_eye) > 0.0) return true;
  }
  return false;
}

TEST(Facing, NothingThatShowsAFrontFacesAway) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-40.0, 40.0);
  for (const bool orthographic : {false, true}) {
    std::size_t away = 0;
    std::size_t without_fronts = 0;
    for (int k = 0; k < 2000; ++k) {
      const Piece piece = bumpy_piece(random);
      Camera camera{
          {number(random), number(random), number(random)}, piece.centre, {0.0, 1.0, 0.1}, 45.0};
      if (orthographic) camera.orthographic_height = 10.0;
      const View view = make_view(camera, 64, 64, 0.01);
      const bool shows = shows_a_front(view, piece);
      if (!shows) ++without_fronts;
      if (!faces_away(view, piece.normals, piece.axes, piece.centre, piece.radius)) continue;
      ++away;
      EXPECT_FALSE(shows) << k;
    }
    // A box holds more normals than the piece has, and a sphere more points: but not twice as many.
    EXPECT_GT(without_fronts, 300U);
    EXPECT_GT(2 * away, without_fronts);
  }
}

TEST(Facing, WhatHasNoKnownNormalsNeverFacesAway) {
  const View view =
      make_view({{0.0, 0.0, -9.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0}, 64, 64, 0.01);
  NormalBounds normals;
  EXPECT_FALSE(faces_away(view, normals, glm::dmat3(1.0), {0.0, 0.0, 0.0}, 1.0));
  normals.add({0.0F, 0.0F, 1.0F});
  EXPECT_TRUE(faces_away(view, normals, glm::dmat3(1.0), {0.0, 0.0, 0.0}, 1.0));
  // From within the sphere the front may be seen.
  EXPECT_FALSE(faces_away(view, normals, glm::dmat3(1.0), {0.0, 0.0, 0.0}, 10.0));
}

}  // namespace
}  // namespace relief
