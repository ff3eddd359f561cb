#include "common/mesh/sharp_mesh.h"

#include <algorithm>
#include <vector>

#include "common/mesh/coarse_mesh.h"
#include "common/mesh/creases.h"
#include "common/mesh/weld.h"

namespace relief {
namespace {

constexpr std::size_t kMostTriangles = 200'000;
// Of the ends of creases, those in a point with two: 80 to 100 % of parts (fandisk 95, anchor 97,
// a nut 88, a teapot 80), 30 to 57 % of scans, statues and animals, 36 % of fandisk with noise.
constexpr double kLeastInLines = 0.75;
// Of edges, those that are creases. A part of 10,000 points has some 4 %.
constexpr double kFewestCreases = 0.005;

}  // namespace

bool is_sharp_mesh(const Points& mesh) {
  if (mesh.triangles.empty() || mesh.triangles.size() > kMostTriangles) return false;
  Points welded;
  welded.positions = mesh.positions;
  welded.triangles = welded_triangles(mesh);
  std::erase_if(welded.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t corner) { return corner >= mesh.size(); });
  });
  const CreaseCensus census = count_creases(welded);
  return static_cast<double>(census.creases) > kFewestCreases * static_cast<double>(census.edges) &&
         static_cast<double>(census.ends_in_lines) >
             kLeastInLines * 2.0 * static_cast<double>(census.creases);
}

bool is_designed_mesh(const Points& mesh) {
  return is_coarse_mesh(mesh) || is_sharp_mesh(mesh);
}

}  // namespace relief
