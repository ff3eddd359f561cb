#include "preprocess/readers/ply/ply_textures.h"

#include <utility>

namespace relief {

void PlyTextures::set_number(double value) {
  number_ = value >= 0.0 && value < static_cast<double>(kNoMaterial)
                ? static_cast<std::uint32_t>(value)
                : kNoMaterial;
}

void PlyTextures::end_face(std::size_t corners, std::size_t before, std::size_t after) {
  const bool whole = corners >= 3 && coordinates_.size() == 2 * corners;
  any_ = any_ || whole;
  if (!any_) return;
  corners_.resize(before);
  numbers_.resize(before, kNoMaterial);
  const auto corner = [this](std::size_t c) {
    return glm::vec2(coordinates_[2 * c], coordinates_[2 * c + 1]);
  };
  // A polygon is a fan about its first corner.
  for (std::size_t c = 2; corners_.size() < after; ++c) {
    corners_.push_back(whole ? CornerTexcoords{corner(0), corner(c - 1), corner(c)}
                             : CornerTexcoords{});
    numbers_.push_back(whole ? number_ : kNoMaterial);
  }
}

void PlyTextures::give(const std::vector<std::string>& pictures, Points& points) {
  if (any_) {
    corners_.resize(points.triangles.size());
    numbers_.resize(points.triangles.size(), kNoMaterial);
    // Of a point with several, the first; triangles have each corner's own.
    points.texcoords.assign(points.size(), glm::vec2(0.0F));
    std::vector<bool> given(points.size(), false);
    for (std::size_t t = 0; t < points.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t p = points.triangles[t][c];
        if (p >= points.size() || given[p]) continue;
        given[p] = true;
        points.texcoords[p] = corners_[t][c];
      }
    }
    points.corner_texcoords = std::move(corners_);
  }
  if (pictures.empty() || points.triangles.empty() || points.texcoords.empty()) return;
  for (const std::string& picture : pictures) {
    MeshMaterial material;
    material.name = material.image = picture;
    material.is_stated = true;
    points.materials.push_back(std::move(material));
  }
  points.triangle_materials.assign(points.triangles.size(), 0);
  if (any_) points.triangle_materials = std::move(numbers_);
  for (std::uint32_t& material : points.triangle_materials) {
    if (material >= pictures.size()) material = kNoMaterial;
  }
}

}  // namespace relief
