// Cuts points into small smooth pieces, within which the sides of normals agree.
#pragma once

#include <cstdint>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"

namespace relief {

/// The piece of each point.
struct SmoothPieces {
  std::vector<std::uint32_t> of_point;
  std::uint32_t count = 0;
};

/// How the sides of two pieces are related by the neighbours across their common border.
struct PieceLink {
  std::uint32_t a = 0;  ///< less than b
  std::uint32_t b = 0;
  float votes = 0.0F;  ///< above 0: the sides agree; the size is about the number of sure pairs
};

/// Flips normals so that those of a piece agree, and returns the pieces: neighbours joined along
/// the surest pairs first (Hoppe et al. 1992, section 3.3), as long as a piece has at most `most`
/// points and pairs are sure. `positions` and unit `normals` belong to `graph`.
[[nodiscard]] SmoothPieces cut_into_pieces(const std::vector<glm::dvec3>& positions,
                                           const NeighbourGraph& graph, std::uint32_t most,
                                           std::vector<glm::vec3>& normals);

/// Returns the links of all pieces with a common border, sorted by a, then b. Their votes are of
/// the normals as cut_into_pieces left them.
[[nodiscard]] std::vector<PieceLink> link_pieces(const std::vector<glm::dvec3>& positions,
                                                 const NeighbourGraph& graph,
                                                 const SmoothPieces& pieces,
                                                 const std::vector<glm::vec3>& normals);

}  // namespace relief
