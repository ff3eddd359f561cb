#include "common/points.h"

namespace relief {

Stance stance_of(const Points& points) {
  if (points.stance) return *points.stance;
  return points.triangles.empty() ? kZUp : Stance{};
}

void repeat_point(Points& points, std::uint32_t index) {
  const auto repeat = [index](auto& values) {
    if (values.empty()) return;
    const auto value = values[index];
    values.push_back(value);
  };
  repeat(points.positions);
  repeat(points.normals);
  repeat(points.colours);
  repeat(points.texcoords);
  repeat(points.scanner_of);
  for (PointScalar& scalar : points.scalars) repeat(scalar.values);
}

CornerTexcoords texcoords_of(const Points& mesh, std::size_t triangle) {
  if (!mesh.corner_texcoords.empty()) return mesh.corner_texcoords[triangle];
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.texcoords[t[0]], mesh.texcoords[t[1]], mesh.texcoords[t[2]]};
}

}  // namespace relief
