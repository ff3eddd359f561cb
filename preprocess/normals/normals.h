// Unit normals for every point, consistently oriented.
#pragma once

#include <cstdint>
#include <vector>

#include "common/points.h"
#include "preprocess/normals/mesh_edges.h"
#include "preprocess/normals/sheets.h"
#include "preprocess/points/neighbours.h"

namespace relief {

struct NormalsReport {
  bool estimated = false;      ///< the scan had no normals
  std::uint64_t repaired = 0;  ///< given normals that were zero, NaN or inconsistent
  Sheets sheets;               ///< of normals that were oriented here; else empty
};

/// The tangent plane of each point by principal component analysis of its neighbours.
struct LocalFrames {
  std::vector<glm::vec3> normals;  ///< unit, sign arbitrary
  std::vector<float> roughness;    ///< rms distance of the neighbours to the plane, world units
};

/// Fits local frames. The neighbourhood adapts: it starts at 8 neighbours (density-adaptive, as k
/// nearest neighbours are) and grows up to all of the graph's while its points are not yet flat
/// enough to tell a plane from noise.
[[nodiscard]] LocalFrames fit_local_frames(const std::vector<glm::dvec3>& positions,
                                           const NeighbourGraph& graph);

/// Makes `points.normals` unit vectors, one per point: the given ones where they hold (zero, NaN
/// and inconsistent ones repaired), else those of the triangles, else local frames oriented by
/// orient_normals. `of_faces`: what normals_of_faces gives, where it is known already.
NormalsReport complete_normals(Points& points, const NeighbourGraph& graph,
                               const LocalFrames& frames,
                               const std::vector<glm::vec3>* of_faces = nullptr);

/// The normals of the points' triangles, if these are oriented and the points have no normals of
/// their own; otherwise none. `edges` are those of the triangles.
[[nodiscard]] std::vector<glm::vec3> normals_of_faces(const Points& points, const MeshEdges& edges);

/// Flips unit normals so that neighbours agree: minimum spanning forest over the neighbour graph
/// (Hoppe et al. 1992). Each connected component then faces the viewpoint if there is one,
/// otherwise outward (faces_inward). Gives the components.
Sheets orient_normals(const Points& points, const NeighbourGraph& graph,
                      std::vector<glm::vec3>& normals);

/// Unit normals averaged over each point's neighbours on the same side: what the partition looks
/// at, so that noise makes no patches.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& normals,
                                                    const NeighbourGraph& graph);

}  // namespace relief
