// Options and report of texture acquisition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace relief {

/// The source of the coefficients w_k.
enum class Acquisition : std::uint8_t {
  Given,            ///< the texture's value at the point, like a scanner's colour
  ViewIndependent,  ///< the texture's mean under the splat: view-independent EWA
  Optimised,        ///< the smallest L2 error, Eq. (11)
};

/// The function on the surface that the Gaussians r_k of [Zwicker 2001], section 3.1, form. Both
/// kinds are scaled to sum to 1, so that a constant texture has that constant as its coefficients.
enum class BasisKind : std::uint8_t {
  /// r_k / sum_j r_j, as shown by engines that divide by the sum of contributions, Eq. (9). The sum
  /// is exactly 1.
  Normalised,
  /// h^2 r_k / (1 - exp(-cutoff)): r_k up to a factor, as in Eq. (1), (7) and (11). With one point
  /// for each h^2 of the surface, the sum is 1 only on average.
  Plain,
};

struct AcquireOptions {
  Acquisition acquisition = Acquisition::Optimised;
  std::size_t points = 100'000;  ///< 1 to max_textured_points()
  /// h of section 5 in distances between points, sqrt(area / points). The fit's error is smallest
  /// at 1.0 to 1.1 (cutoff 1); at 1.1 the sum of kernels is below 0.4 (tau of section 7) at 1
  /// position in 100,000, at 1.0 at 1 in 600.
  double deviation = 1.1;
  double cutoff = 1.0;  ///< cutoff of the engine that draws the splats
  BasisKind basis = BasisKind::Normalised;
};

/// Returns the largest number of points that memory allows: the basis at the positions of the fit
/// takes 40 bytes for each of its entries at its peak, 4 GB here. 820,000 points with the defaults,
/// fewer with a larger deviation or cutoff.
[[nodiscard]] std::size_t max_textured_points(double deviation, double cutoff);

/// Statistics of the linear solver. Unmeasured quantities are absent.
struct FitReport {
  int iterations = 0;               ///< the largest of the channels
  double residual = 0.0;            ///< |c - R w| / |c|, the largest of the channels
  std::optional<double> condition;  ///< of R scaled to a unit diagonal, estimated from below
};

struct AcquireReport {
  double area = 0.0;              ///< of the mesh, world units squared
  double texels_per_point = 0.0;  ///< texels of the texture for each point
  double rms_error = 0.0;         ///< of the splats' function against the texture, linear light
  std::optional<FitReport> fit;   ///< of Optimised
};

}  // namespace relief
