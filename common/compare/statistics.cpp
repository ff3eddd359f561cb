#include "common/compare/statistics.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace relief {

double SquaredErrors::rms() const {
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

SquaredErrors sum_rows(std::uint32_t rows,
                       const std::function<SquaredErrors(std::uint32_t)>& row_errors) {
  std::vector<SquaredErrors> parts(rows);
  tbb::parallel_for(std::uint32_t{0}, rows,
                    [&](std::uint32_t row) { parts[row] = row_errors(row); });
  SquaredErrors total;
  for (const SquaredErrors& part : parts) {
    total.sum += part.sum;
    total.count += part.count;
  }
  return total;
}

double psnr_db(double rms, double peak) {
  if (rms == 0.0) return std::numeric_limits<double>::infinity();
  return 20.0 * std::log10(peak / rms);
}

double percentile(std::vector<float>& values, double fraction) {
  assert(!values.empty() && fraction > 0.0 && fraction <= 1.0);
  const double rank = std::ceil(fraction * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace relief
