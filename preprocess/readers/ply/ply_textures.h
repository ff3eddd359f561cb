// Texture coordinates of the faces of PLY files, as MeshLab writes them: a list `texcoord` of u and
// v for each corner, and the number of one of several pictures, `texnumber`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/points.h"

namespace relief {

/// Collects texture coordinates face by face. Values are not trusted.
class PlyTextures {
 public:
  void begin_face() {
    coordinates_.clear();
    number_ = 0;
  }
  void add_coordinate(double value) { coordinates_.push_back(static_cast<float>(value)); }
  /// The face's picture, from 0; any other value: none.
  void set_number(double value);
  /// `corners`: of the face. `before`, `after`: triangles of the mesh without and with the face's.
  void end_face(std::size_t corners, std::size_t before, std::size_t after);

  /// Gives the points what was collected, if anything was, and materials of the pictures, which
  /// are named relative to the file. Pictures need texture coordinates, of faces or of vertices.
  void give(const std::vector<std::string>& pictures, Points& points);

 private:
  std::vector<float> coordinates_;        ///< of the face: u, v, u, v ...
  std::uint32_t number_ = 0;              ///< kNoMaterial: none
  bool any_ = false;                      ///< faces with coordinates
  std::vector<CornerTexcoords> corners_;  ///< empty until a face has coordinates
  std::vector<std::uint32_t> numbers_;
};

}  // namespace relief
