// The pieces of a scan whose sides are chosen.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "preprocess/normals/known_sides.h"
#include "preprocess/normals/smooth_pieces.h"
#include "preprocess/normals/winding_numbers.h"

namespace relief {

/// What two pieces of the surface gain by agreeing, beside an error of the winding number of one
/// about a place.
struct SideCoupling {
  std::uint32_t a = 0;  ///< places in SidePieces::chosen
  std::uint32_t b = 0;
  float gain = 0.0F;  ///< world units squared; below 0: by facing apart
};

/// Smooth pieces, and the surface of the largest of them, whose sides are chosen.
struct SidePieces {
  SmoothPieces all;
  std::vector<PieceLink> links;  ///< of all
  std::vector<float> areas;      ///< of all, world units squared
  std::vector<float> towards;    ///< of all: areas as the known direction sees them, world units
                                 ///< squared; negative: from behind
  std::vector<std::uint32_t> chosen;    ///< those of the surface, by number of points, most first
  std::vector<std::uint32_t> node;      ///< of all: their place in `chosen`, or kNoNode
  std::vector<SideCoupling> couplings;  ///< of the surface
  PiecedSurface surface;
  glm::dvec3 centre{0.0};  ///< what the surface's positions are relative to

  static constexpr std::uint32_t kNoNode = UINT32_MAX;

  /// The number of pieces of the surface.
  [[nodiscard]] std::size_t count() const { return chosen.size(); }
};

/// How many pieces there shall be.
struct PieceLimits {
  std::size_t most_points = 0;  ///< of a piece; pieces have about half as many
  std::size_t most_chosen = 0;
};

/// The limits of at most `most` pieces of this many points.
[[nodiscard]] PieceLimits limits_for(std::size_t points, std::size_t most);

/// Cuts the points into pieces, and flips normals so that those of a piece agree. Pieces smaller
/// than a sixteenth of the limit are slivers and not chosen.
[[nodiscard]] SidePieces make_side_pieces(const Points& points, const NeighbourGraph& graph,
                                          const KnownSides& known, const PieceLimits& limits,
                                          std::vector<glm::vec3>& normals);

/// Returns the sides of the chosen pieces that turn most of `normals`, which are theirs, to where
/// they faced before.
[[nodiscard]] Eigen::VectorXf sides_as(const std::vector<glm::vec3>& before,
                                       const SidePieces& pieces, const NeighbourGraph& graph,
                                       const std::vector<glm::vec3>& normals);

/// Turns the normals of the chosen pieces as chosen. Others face the known direction if it leads
/// slivers and they are not along it. Otherwise they follow along the links with the most votes;
/// pieces without a link to one of those face the known direction.
void turn_pieces(const SidePieces& pieces, const Eigen::VectorXf& sides, const KnownSides& known,
                 std::vector<glm::vec3>& normals);

}  // namespace relief
