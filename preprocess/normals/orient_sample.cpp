#include "preprocess/normals/orient_sample.h"

#include <utility>

#include "common/neighbours/neighbours.h"
#include "preprocess/normals/normals.h"

namespace relief {

SampledSides orient_sample(std::vector<glm::dvec3> points, const SideChoice& choice,
                           const Progress& progress) {
  Points sample;
  sample.positions = std::move(points);
  const NeighbourGraph graph = find_neighbours(sample.positions, kSurfaceNeighbours);
  const LocalFrames frames = fit_local_frames(sample.positions, graph);
  complete_normals(sample, graph, frames, {.side = choice}, progress);
  return {sample.positions, std::move(sample.normals)};
}

}  // namespace relief
