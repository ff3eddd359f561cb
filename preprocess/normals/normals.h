// Estimates unit normals for every point, consistently oriented.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh_edges.h"
#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/normals/known_sides.h"
#include "preprocess/normals/sheets.h"

namespace relief {

struct NormalsReport {
  bool estimated = false;      ///< the scan had no normals
  std::uint64_t repaired = 0;  ///< given normals that were zero, NaN or inconsistent
  bool oriented = false;       ///< their sides were chosen: neither the file's nor those of faces
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

/// Takes these normals instead, unit or 0 where none is known: those over wide supports are better
/// than those of the nearest neighbours. A mesh with points added has more points than `known`.
void take_known_normals(const std::vector<glm::vec3>& known, LocalFrames& frames);

struct NormalsOptions {
  /// If not Auto, given normals are turned, too. Those of faces have the faces' side always.
  SideChoice side;
  /// The result of normals_of_faces; null: it is computed.
  const std::vector<glm::vec3>* of_faces = nullptr;
  /// The points' normals are those of triangles that agree about their sides: nothing is repaired.
  bool are_of_faces = false;
};

/// Makes `points.normals` unit vectors, one per point: the given normals (zero, NaN and
/// inconsistent ones repaired), or those of the triangles, or local frames oriented by
/// orient_normals. Incomplete if the user interrupts.
NormalsReport complete_normals(Points& points, const NeighbourGraph& graph,
                               const LocalFrames& frames, const NormalsOptions& options = {},
                               const Progress& progress = Progress());

/// Returns the normals of the points' triangles, if these are oriented and the points have no
/// normals; empty otherwise. `edges` are the triangles' edges.
[[nodiscard]] std::vector<glm::vec3> normals_of_faces(const Points& points, const MeshEdges& edges);

/// Flips unit normals so that they face one side of each surface.
///
/// The points are cut into small smooth pieces (cut_into_pieces). The sides of pieces are chosen so
/// that the winding number of the whole surface about its own points is a half, as it is for closed
/// surfaces that face outward ([Lin 2024] has that condition for each point), or less if an open
/// ground fits better so, that neighbours across the borders of pieces agree, and that normals face
/// the known direction, each as far as the others let them. Where the direction is sure
/// (KnownSides), it decides at each point. In large scans small pieces are chosen again
/// (refine_sides).
///
/// Returns that winding number. The result does not depend on the number of threads. Incomplete if
/// the user interrupts.
float orient_normals(const Points& points, const NeighbourGraph& graph, const SideChoice& choice,
                     std::vector<glm::vec3>& normals, const Progress& progress);

/// Returns the sheets: neighbours whose normals agree.
[[nodiscard]] Sheets find_sheets(const NeighbourGraph& graph,
                                 const std::vector<glm::vec3>& normals);

/// Returns unit normals averaged over each point's neighbours on its side. The partition uses them,
/// so that noise makes no patches.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& normals,
                                                    const NeighbourGraph& graph);

}  // namespace relief
