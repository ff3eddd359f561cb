// What can be chosen about texture acquisition, and what it reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace relief {

/// Where the coefficients w_k come from.
enum class Acquisition : std::uint8_t {
  Given,            ///< the texture's value at the point, as a scanner gives a colour per point
  ViewIndependent,  ///< the texture's mean under the splat: view-independent EWA
  Optimised,        ///< the least L2 error, Eq. (11)
};

/// How the Gaussians r_k of paper 000, section 3.1, become a function on the surface. Both kinds
/// are scaled to sum to 1, so that a constant texture has that constant as its coefficients.
enum class BasisKind : std::uint8_t {
  /// r_k / sum_j r_j: what an engine shows that divides by the sum of the contributions, Eq. (9).
  /// The sum is exactly 1.
  Normalised,
  /// h^2 r_k / (1 - exp(-cutoff)): r_k itself up to a factor, as in Eq. (1), (7) and (11). With one
  /// point for each h^2 of the surface the sum is 1 on average only.
  Plain,
};

struct AcquireOptions {
  Acquisition acquisition = Acquisition::Optimised;
  std::size_t points = 100'000;  ///< 1 to most_textured_points()
  /// h of section 5 in distances of points, sqrt(area / points). The fit's error is least at 1.0 to
  /// 1.1 (cutoff 1); at 1.1 the sum of kernels is below 0.4 (tau of section 7) at 1 place in
  /// 100,000, at 1.0 at 1 in 600.
  double deviation = 1.1;
  double cutoff = 1.0;  ///< that of the engine that draws the splats
  BasisKind basis = BasisKind::Normalised;
};

/// What memory allows: the basis at the places of the fit takes 40 bytes for each of its entries at
/// its peak, 4 GB here. 820,000 points with the defaults, fewer with a larger deviation or cutoff.
[[nodiscard]] std::size_t most_textured_points(double deviation, double cutoff);

/// How the linear system went. What could not be measured is not there.
struct FitReport {
  int iterations = 0;               ///< the most that a channel took
  double residual = 0.0;            ///< |c - R w| / |c|, the largest of the channels
  std::optional<double> condition;  ///< of R scaled to a unit diagonal, estimated from below
};

struct AcquireReport {
  double area = 0.0;              ///< of the mesh, world units squared
  double texels_per_point = 0.0;  ///< how much finer than the points the texture is
  double rms_error = 0.0;  ///< of the function on the splats against the texture, linear light
  std::optional<FitReport> fit;  ///< of Optimised
};

}  // namespace relief
