#include "common/mesh/weld.h"

#include "common/is_finite.h"
#include "common/mesh/seen_positions.h"

namespace relief {

std::vector<Triangle> welded_triangles(const Points& mesh) {
  SeenPositions seen(mesh.size());
  std::vector<std::uint32_t> first;
  first.reserve(mesh.size());
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    first.push_back(is_finite(mesh.positions[i]) ? seen.find_or_add(mesh.positions, i) : i);
  std::vector<Triangle> welded = mesh.triangles;
  for (Triangle& t : welded) {
    for (std::uint32_t& corner : t) {
      if (corner < first.size()) corner = first[corner];
    }
  }
  return welded;
}

}  // namespace relief
