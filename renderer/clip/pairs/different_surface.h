// When two splats are of different surfaces.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "renderer/clip/pairs/disc_tree.h"

namespace relief {

/// Eq. (2) of [Ivo 2011] with a threshold for each disc of a tree. Two discs are of different
/// surfaces if the dot product of their normals is below both thresholds, unless their planes are
/// nearly parallel: the two sides of a thin wall have opposite normals, but no edge.
class SurfaceTest {
 public:
  /// One threshold for all discs, or without one thresholds from the noise of the normals.
  ///
  /// A disc's noise is the angle that a fifth of its neighbours' normals stay below. Even in a
  /// corner of five faces about that many are on its own face. Where noise is even in all
  /// directions (angles follow a Rayleigh distribution), 1 in 60,000 exceeds seven times this
  /// angle. On a cylinder the largest angle between neighbours is 6.4 times as large, so no bend is
  /// an edge, however tight it is. The threshold is seven times the noise, or the median noise of
  /// its neighbours if that is less, at least 30 and at most 60 degrees: real edges are kept where
  /// half of the neighbours are beyond one, and at the tip of a corner.
  SurfaceTest(const DiscTree& tree, std::optional<double> threshold);

  [[nodiscard]] bool differ(const DiscTree& tree, std::size_t slot, std::size_t other) const;

  /// The noise of a disc's normals, radians; at most 60 / 7 degrees.
  [[nodiscard]] double noise(std::size_t slot) const { return double{noise_[slot]}; }
  /// The median of the thresholds.
  [[nodiscard]] double threshold() const;

 private:
  struct Limits {
    double cosine;
    double squared_sine;
  };

  static Limits limits_of(double angle);
  [[nodiscard]] const Limits& of(std::size_t slot) const {
    return limits_.size() == 1 ? limits_.front() : limits_[slot];
  }

  std::vector<float> noise_;    // of each slot
  std::vector<Limits> limits_;  // of each slot, or one for all
};

}  // namespace relief
