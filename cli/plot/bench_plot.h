// What `relief bench --plot` draws.
#pragma once

#include "cli/plot/scatter_plot.h"
#include "cli/reports/bench_report.h"

namespace relief::cli {

/// PSNR against frame time: in the rows' material and, beside it, as a mirror (whose time is not
/// another: it is the accuracy alone that is looked at there). Rows whose PSNR was not measured or
/// is infinite are not in it. The default is marked; the bound and the mesh are lines.
[[nodiscard]] Plot plot_of(const BenchResult& result);

}  // namespace relief::cli
