// A scan with all that the partition and the resampling look at.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "preprocess/partition/partition.h"

namespace relief::test {

struct Prepared {
  explicit Prepared(Points scan) : points(std::move(scan)) {
    graph = find_neighbours(points.positions, 16);
    frames = fit_local_frames(points.positions, graph);
    complete_normals(points, graph, frames);
  }

  [[nodiscard]] SurfaceSamples samples() const {
    return {points.positions, points.normals, graph.spacing, frames.roughness};
  }
  [[nodiscard]] std::vector<Region> regions(double cone_degrees) const {
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    Progress progress;
    return partition(samples(), graph, std::move(all), cone_degrees, nullptr, progress);
  }

  Points points;
  NeighbourGraph graph;
  LocalFrames frames;
};

}  // namespace relief::test
