// Colours of the faces of a mesh file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"
#include "preprocess/readers/colours.h"

namespace relief {

/// Collects the colours of faces, in the order of their triangles. Values are not trusted.
class FaceColours {
 public:
  /// Gives triangles `before` to `after` of the mesh a colour as its file has it. Those that get
  /// none are white.
  void add(glm::vec3 colour, ColourNumbers numbers, std::size_t before, std::size_t after);

  /// Gives the points what was collected, unless they have colours or pictures already, or all
  /// faces are white: materials if there are at most kMostMaterials colours, as of the parts of an
  /// assembly; otherwise each vertex the mean of its faces' colours, as of a measured quantity.
  void give(Points& points);

  static constexpr std::size_t kMostMaterials = 256;

 private:
  std::vector<glm::vec3> of_triangles_;  ///< as read; empty until a face has a colour
  ColourNumbers numbers_ = ColourNumbers::Integer;
};

}  // namespace relief
