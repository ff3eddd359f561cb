// Estimates unit normals for every point, consistently oriented.
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
  Sheets sheets;               ///< of the oriented normals; empty if normals were given
};

/// Tangent planes of points by principal component analysis of their neighbours.
struct LocalFrames {
  std::vector<glm::vec3> normals;  ///< unit, sign arbitrary
  std::vector<float> roughness;    ///< rms distance of the neighbours to the plane, world units
};

/// Fits local frames. The neighbourhood adapts: it starts at 8 neighbours (adaptive to density, as
/// all k nearest neighbours are) and grows up to all of the graph's until its points are flat
/// enough to distinguish a plane from noise.
[[nodiscard]] LocalFrames fit_local_frames(const std::vector<glm::dvec3>& positions,
                                           const NeighbourGraph& graph);

/// Makes `points.normals` unit vectors, one per point: the given normals (zero, NaN and
/// inconsistent ones repaired), or those of the triangles, or local frames oriented by
/// orient_normals. `of_faces`: the result of normals_of_faces, if already computed.
NormalsReport complete_normals(Points& points, const NeighbourGraph& graph,
                               const LocalFrames& frames,
                               const std::vector<glm::vec3>* of_faces = nullptr);

/// Returns the normals of the points' triangles, if these are oriented and the points have no
/// normals; empty otherwise. `edges` are the triangles' edges.
[[nodiscard]] std::vector<glm::vec3> normals_of_faces(const Points& points, const MeshEdges& edges);

/// Flips unit normals so that neighbours agree: minimum spanning forest over the neighbour graph
/// (Hoppe et al. 1992). Each connected component then faces the viewpoint if there is one,
/// otherwise outward (faces_inward). Returns the components.
Sheets orient_normals(const Points& points, const NeighbourGraph& graph,
                      std::vector<glm::vec3>& normals);

/// Returns unit normals averaged over each point's neighbours on its side. The partition uses them,
/// so that noise makes no patches.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& normals,
                                                    const NeighbourGraph& graph);

}  // namespace relief
