// Sums over pixels that do not depend on the number of threads, and what is made of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace relief {

/// A sum of squared errors and how many values are in it.
struct SquaredErrors {
  double sum = 0.0;
  std::uint64_t count = 0;

  void add(double error) {
    sum += error * error;
    ++count;
  }
  /// Root of the mean square; 0 where nothing was added.
  [[nodiscard]] double rms() const;
};

/// Adds up what `row_errors` finds in each of the rows 0 to rows - 1. Rows are looked at in
/// parallel and added in their order, so that the sum is the same with any number of threads.
/// `row_errors` is called from several threads.
[[nodiscard]] SquaredErrors sum_rows(
    std::uint32_t rows, const std::function<SquaredErrors(std::uint32_t row)>& row_errors);

/// Peak signal-to-noise ratio 20 log10(peak / rms) in dB; +infinity where rms is 0.
[[nodiscard]] double psnr_db(double rms, double peak);

/// The smallest of `values` that at least `fraction` (above 0, up to 1) of them do not exceed
/// (nearest rank). Reorders `values`, of which there must be one.
[[nodiscard]] double percentile(std::vector<float>& values, double fraction);

}  // namespace relief
