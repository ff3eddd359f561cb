// Sums over pixels that do not depend on the number of threads, and statistics of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace relief {

/// A sum of squared errors and the number of values in it.
struct SquaredErrors {
  double sum = 0.0;
  std::uint64_t count = 0;

  void add(double error) {
    sum += error * error;
    ++count;
  }
  /// Returns the root mean square; 0 without values.
  [[nodiscard]] double rms() const;
};

/// Adds up the results of `row_errors` for rows 0 to rows - 1. Rows are computed in parallel and
/// added in order, so that the sum does not depend on the number of threads. `row_errors` is called
/// from several threads.
[[nodiscard]] SquaredErrors sum_rows(
    std::uint32_t rows, const std::function<SquaredErrors(std::uint32_t row)>& row_errors);

/// Returns the peak signal-to-noise ratio 20 log10(peak / rms) in dB; +infinity where rms is 0.
[[nodiscard]] double psnr_db(double rms, double peak);

/// Returns the smallest of `values` that at least `fraction` (above 0, up to 1) of them do not
/// exceed (nearest rank). Reorders `values`, which must not be empty.
[[nodiscard]] double percentile(std::vector<float>& values, double fraction);

}  // namespace relief
