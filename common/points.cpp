#include "common/points.h"

namespace relief {

Stance stance_of(const Points& points) {
  if (points.stance) return *points.stance;
  return points.triangles.empty() ? kZUp : Stance{};
}

CornerTexcoords texcoords_of(const Points& mesh, std::size_t triangle) {
  if (!mesh.corner_texcoords.empty()) return mesh.corner_texcoords[triangle];
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.texcoords[t[0]], mesh.texcoords[t[1]], mesh.texcoords[t[2]]};
}

}  // namespace relief
