#include "cli/reports/convert_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

namespace relief::cli {
namespace {

/// Peak memory of this process.
std::uint64_t peak_bytes() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// What was found of noise and stray points; empty for a scan without either.
std::string noise_line(const ConvertReport& report) {
  std::string line;
  if (report.points_moved > 0) {
    line = fmt::format("{:.3g} (standard deviation), removed from {} points", report.noise,
                       report.points_moved);
  }
  if (report.stray_points > 0) {
    line +=
        fmt::format("{}{} stray points left out", line.empty() ? "" : "; ", report.stray_points);
  }
  return line.empty() ? line : fmt::format("  noise             {}\n", line);
}

/// How many points were merged; empty for a scan whose points lie in no lines.
std::string lines_line(const ConvertReport& report) {
  if (report.points_merged == 0) return {};
  return fmt::format("  merged            {} points that lie in lines, far denser than across\n",
                     report.points_merged);
}

/// How many points were left out by choice; empty if all were chosen.
std::string selection_line(const ReadResult& read) {
  if (read.not_selected == 0) return {};
  return fmt::format("  not selected      {} points\n", read.not_selected);
}

}  // namespace

nlohmann::ordered_json convert_json(const ConvertSummary& s) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& stage : s.stages)
    stages[stage.name] = stages.value(stage.name, 0.0) + stage.seconds;  // some ran more than once
  // nlohmann writes numbers that are not finite (the PSNR of a perfect plane) as null.
  return {{"points", s.report.points},
          {"points_dropped", s.read.dropped_nonfinite},
          {"points_left_out", s.read.left_out},
          {"points_not_selected", s.read.not_selected},
          {"duplicates_merged", s.read.merged_duplicates},
          {"points_merged", s.report.points_merged},
          {"outliers_removed", s.outliers.sparse},
          {"cluster_points_removed", s.outliers.cluster},
          {"stray_points_removed", s.report.stray_points},
          {"points_thinned", s.thinned},
          {"noise", s.report.noise},
          {"points_moved", s.report.points_moved},
          {"normals_estimated", s.report.normals_estimated},
          {"points_added", s.report.points_added},
          {"normals_repaired", s.report.normals_repaired},
          {"fits", s.report.fits},
          {"fits_replaced", s.report.fits_replaced},
          {"fit_condition", s.report.fit_condition},
          {"patches", s.file.patches},
          {"samples", s.file.samples},
          {"spacing", s.file.spacing},
          {"finest_spacing", s.report.finest_spacing},
          {"coarsest_spacing", s.report.coarsest_spacing},
          {"file_bytes", s.file.file_bytes},
          {"height_bytes", s.file.height_bytes},
          {"normal_bytes", s.file.normal_bytes},
          {"colour_bytes", s.file.colour_bytes},
          {"seconds", s.seconds},
          {"error_rms", s.report.error_rms},
          {"error_max", s.report.error_max},
          {"psnr_db", s.report.psnr_db},
          {"uncovered_points", s.report.uncovered_points},
          {"texels_per_cell", s.report.texels_per_cell},
          {"colour_texels", s.report.colour_texels},
          {"normal_texels_per_cell", s.report.normal_texels_per_cell},
          {"normal_texels", s.report.normal_texels},
          {"tiles", s.tiled ? s.tiled->tiles : 1},
          {"tiles_found", s.tiled ? s.tiled->tiles_found : 0},
          {"halo_points", s.tiled ? s.tiled->halo_points : 0},
          {"peak_bytes", peak_bytes()},
          {"stage_seconds", stages}};
}

std::string convert_text(const ConvertSummary& s, const std::filesystem::path& output) {
  std::string normals = s.report.normals_estimated
                            ? "estimated"
                            : fmt::format("given, {} repaired", s.report.normals_repaired);
  if (s.report.normal_texels_per_cell > 1)
    normals += fmt::format("; {} texels, up to {} a cell along a side", s.report.normal_texels,
                           s.report.normal_texels_per_cell);
  const std::string colours = s.report.texels_per_cell == 0
                                  ? "none"
                                  : fmt::format("{} texels, up to {} a cell along a side",
                                                s.report.colour_texels, s.report.texels_per_cell);
  const std::string tiles =
      s.tiled ? fmt::format("  tiles             {}, {} of them from an earlier run\n",
                            s.tiled->tiles, s.tiled->tiles_found)
              : "";
  const std::string spacings = s.report.finest_spacing < s.report.coarsest_spacing
                                   ? fmt::format(", of patches {:.3g} to {:.3g}",
                                                 s.report.finest_spacing, s.report.coarsest_spacing)
                                   : "";
  std::string text = fmt::format(
      "{}\n"
      "  points            {} ({} not finite dropped, {} duplicates merged)\n"
      "{}{}{}"
      "  normals           {}\n"
      "  patches           {}\n"
      "  samples           {}\n"
      "  spacing           {:.6g}{}\n"
      "  error             {:.3g} rms, {:.3g} at most\n"
      "  psnr              {:.2f} dB\n"
      "  uncovered points  {}\n"
      "  colours           {}\n"
      "  file              {} bytes, {:.2f} bits per sample\n"
      "{}"
      "  time              {:.2f} s",
      output.string(), s.report.points, s.read.dropped_nonfinite, s.read.merged_duplicates,
      selection_line(s.read), lines_line(s.report), noise_line(s.report), normals, s.file.patches,
      s.file.samples, s.file.spacing, spacings, s.report.error_rms, s.report.error_max,
      s.report.psnr_db, s.report.uncovered_points, colours, s.file.file_bytes,
      8.0 * static_cast<double>(s.file.file_bytes) / static_cast<double>(s.file.samples), tiles,
      s.seconds);
  const char* separator = ": ";
  for (const auto& stage : s.stages) {
    text += fmt::format("{}{} {:.2f}", separator, stage.name, stage.seconds);
    separator = ", ";
  }
  if (s.outliers.sparse + s.outliers.cluster + s.thinned > 0)
    text += fmt::format("\n  removed           {} outliers, {} in small clusters, {} by thinning",
                        s.outliers.sparse, s.outliers.cluster, s.thinned);
  return text + "\n";
}

}  // namespace relief::cli
