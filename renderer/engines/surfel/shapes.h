// The primitives of Figure 2 of [Textured surfels]: a polygon, and a slightly curved surface.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief::surfel {

/// Corners about the disc of radius 1, the first on the first axis, and triangles between them,
/// counter-clockwise seen from the normal's tip.
struct ShapeOutline {
  std::vector<glm::vec2> corners;
  std::vector<std::uint16_t> triangles;  ///< three corners each
};

/// The regular polygon about the disc.
[[nodiscard]] ShapeOutline polygon_outline(int sides);

/// A fan of triangles about the disc, and rings of quads around that: bent, it is off the surface
/// by at most 1/kCurvedRings^2 of the height at the rim.
[[nodiscard]] ShapeOutline curved_outline();

inline constexpr int kCurvedSides = 8;
inline constexpr int kCurvedRings = 2;

/// A shape on the GPU, drawn any number of times by one call.
class Shape {
 public:
  Shape(const Gl& gl, const ShapeOutline& outline);

  /// Draws `count` surfels with the program, from `first` in the list of drawn ones on. The list,
  /// the tables and the program are bound.
  void draw(const Program& program, std::uint32_t first, std::uint32_t count) const;

 private:
  const Gl* gl_;
  Table corners_;
  Buffer elements_;
  VertexArray vertices_;
  std::uint32_t corner_bits_ = 0;     ///< 0: a triangle, without elements
  std::uint32_t surfel_indices_ = 3;  ///< of a surfel
  std::uint32_t per_draw_ = 0;        ///< surfels whose elements there are; 0: any number
};

}  // namespace relief::surfel
