#include "preprocess/normals/orient_sample.h"

#include <utility>

#include "common/neighbours/neighbours.h"
#include "preprocess/normals/normals.h"
#include "preprocess/normals/side_pieces.h"
#include "preprocess/points/stray_points.h"

namespace relief {
namespace {

// Pieces that parts of the scan see: each of a tile's 3,600 places sees as many dipoles as points
// of near pieces.
constexpr std::size_t kSamplePieces = 4000;

/// The surface of a sample in pieces that face as its normals do.
SidePieces pieces_as(const Points& sample, const NeighbourGraph& graph, const KnownSides& known) {
  std::vector<glm::vec3> normals = sample.normals;
  SidePieces pieces =
      make_side_pieces(sample, graph, known, limits_for(sample.size(), kSamplePieces), normals);
  const Eigen::VectorXf sides = sides_as(sample.normals, pieces, graph, normals);
  PiecedSurface& surface = pieces.surface;
  for (std::size_t k = 0; k < pieces.count(); ++k) {
    for (std::uint32_t i = surface.first[k]; i < surface.first[k + 1]; ++i)
      surface.area_normals[i] *= sides[static_cast<Eigen::Index>(k)];
  }
  return pieces;
}

}  // namespace

SampledSides orient_sample(std::vector<glm::dvec3> points, const SideChoice& choice,
                           const Progress& progress) {
  Points sample;
  sample.positions = std::move(points);
  NeighbourGraph graph = find_neighbours(sample.positions, kSurfaceNeighbours);
  drop_stray_points(sample, graph, progress);
  sample.normals = fit_local_frames(sample.positions, graph).normals;
  const float number = orient_normals(sample, graph, choice, sample.normals, progress);
  SidePieces pieces = pieces_as(sample, graph, known_sides(sample, choice));
  return {sample.positions, std::move(sample.normals), std::move(pieces.surface), pieces.centre,
          number};
}

}  // namespace relief
