// How well discs cover a surface: the gaps and the overlap, for every factor of their radii at
// once.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace relief::test {

/// Points of a surface with its normals there, spread evenly.
struct SurfaceSamples {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  ///< unit
};

/// What a disc covers of a surface: the samples whose line along the surface's normal meets it, at
/// most its radius away, where both face the same way.
class DiscCoverage {
 public:
  /// Factors beyond that are not told apart.
  static constexpr double kMostScale = 6.0;

  DiscCoverage(const SurfaceSamples& surface, std::span<const glm::dvec3> centres,
               std::span<const glm::vec3> normals, std::span<const double> diameters);

  /// The share of the surface in no disc, whose diameters are multiplied by `scale`.
  [[nodiscard]] double uncovered(double scale) const;
  /// The mean number of discs over a place of the surface.
  [[nodiscard]] double overlap(double scale) const;
  /// The smallest scale that leaves at most this share uncovered; kMostScale if none does.
  [[nodiscard]] double closing(double share) const;
  /// Of each sample, the scale from which on it is covered; infinity: not at kMostScale.
  [[nodiscard]] const std::vector<float>& needed() const { return needed_; }

 private:
  static constexpr std::size_t kBins = 1200;
  std::vector<float> needed_;
  std::vector<float> sorted_;
  std::vector<std::uint64_t> covers_;  // by scale: pairs of samples and discs that begin there
};

}  // namespace relief::test
