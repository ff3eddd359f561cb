// The position on a triangle that is nearest to another.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// Returns the position on the triangle (a, b, c) nearest to `p` (Ericson, "Real-Time Collision
/// Detection", 5.1.5), by which of its corners, edges or inside is nearest. The triangle may be
/// degenerate.
[[nodiscard]] inline glm::dvec3 nearest_on_triangle(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b,
                                                    glm::dvec3 c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + (vb * ab + vc * ac) / sum;
}

}  // namespace relief
