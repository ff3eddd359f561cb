// The plot of `relief bench --plot`.
#pragma once

#include "cli/plot/scatter_plot.h"
#include "cli/reports/bench_report.h"

namespace relief::cli {

/// Plots PSNR against frame time: one panel for the rows' material and one for a mirror, with the
/// same times; where engines are compared, one over the pixels that row and truth cover, and one
/// over all, in which silhouettes weigh most. Leaves out rows whose PSNR was not measured or is
/// infinite. The default is marked; the bound and the mesh are lines.
[[nodiscard]] Plot plot_of(const BenchResult& result);

}  // namespace relief::cli
