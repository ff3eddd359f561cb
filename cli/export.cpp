// relief export: writes the surface of patches to a file that other programs read.
#include "common/export/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/output_file.h"
#include "cli/options/paths.h"
#include "cli/options/read_options.h"
#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "loader/load_files.h"
#include "renderer/geometry/meshes/points_of_patches.h"

namespace relief::cli {
namespace {

constexpr const char* kExportExamples =
    "Points are the samples of the patches, with their normals and colours, in the scan's\n"
    "coordinates. A mesh joins the samples of each patch with triangles, as `relief render "
    "--engine\n"
    "raytrace` does. Patches that meet at seams become one mesh; others are not joined to each "
    "other,\n"
    "and overlap by a margin.\n"
    "\n"
    "Examples:\n"
    "  relief export dragon.relief -o dragon.ply\n"
    "  relief export dragon.relief -o dragon.glb\n"
    "  relief export dragon.relief -o dragon.ply --as mesh --json";

struct ExportArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::string as;  ///< "mesh" or "points"; empty: the default of the format
  ReadOptions read;
  bool json = false;
};

/// A format that can be written.
struct Format {
  std::string_view ending;
  Status (*write)(const std::filesystem::path&, const ExportRequest&, Progress&);
  bool is_mesh;  ///< by default
};
constexpr Format kFormats[] = {
    {".ply", export_ply, false}, {".obj", export_obj, true}, {".glb", export_glb, true}};

const Format* format_of(const std::filesystem::path& output) {
  for (const Format& format : kFormats) {
    if (format.ending == lower_extension(output)) return &format;
  }
  return nullptr;
}

struct Summary {
  std::string_view as;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool normals = true;
  bool colours = false;
  std::uint64_t file_bytes = 0;
  double seconds = 0.0;
};

Result<Summary> export_file(const ExportArguments& arguments, Progress& progress) {
  const Format& format = *format_of(arguments.output);
  RELIEF_TRY_ASSIGN(auto model, load_model(arguments.input, progress, arguments.read));
  const bool as_mesh = arguments.as.empty() ? format.is_mesh : arguments.as == "mesh";
  const bool is_closed = model.is_closed;
  // Heights are coded in steps of a twentieth of the spacing; a fiftieth of a step more does
  // not show.
  const double tolerance = model.spacing / 1000.0;
  progress.begin_stage("mesh", 0);
  auto made = as_mesh ? surface_mesh(model) : sample_points(model);
  if (!made) return make_error("{}: {}", arguments.input.string(), made.error().message);
  model = {};  // frees memory: the export is as large
  const Points& points = *made;
  if (points.positions.empty())
    return make_error("{}: has no samples to export", arguments.input.string());
  if (as_mesh && points.triangles.empty()) {
    return make_error("{}: has no triangles, only single samples; export them with --as points",
                      arguments.input.string());
  }
  const Status written = format.write(arguments.output, {points, tolerance, is_closed}, progress);
  if (!written) return written.error();
  InterruptedFiles::note_complete();
  std::error_code ignored;
  return Summary{
      as_mesh ? "mesh" : "points", points.size(),
      points.triangles.size(),     !points.normals.empty(),
      !points.colours.empty(),     std::filesystem::file_size(arguments.output, ignored)};
}

nlohmann::ordered_json as_json(const Summary& s, const ExportArguments& arguments) {
  return {{"output", arguments.output.string()},
          {"as", s.as},
          {"vertices", s.vertices},
          {"triangles", s.triangles},
          {"normals", s.normals},
          {"colours", s.colours},
          {"file_bytes", s.file_bytes},
          {"seconds", s.seconds}};
}

std::string as_text(const Summary& s, const ExportArguments& arguments) {
  return fmt::format(
      "{}\n"
      "  as          {}\n"
      "  vertices    {}\n"
      "  triangles   {}\n"
      "  attributes  normal{}\n"
      "  file        {} bytes\n"
      "  time        {:.2f} s\n",
      arguments.output.string(), s.as, s.vertices, s.triangles, s.colours ? ", colour" : "",
      s.file_bytes, s.seconds);
}

int run_export(ExportArguments arguments) {
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path named = arguments.output;
  auto output = OutputFile::open(named, ".ply");
  if (!output) return fail(output.error());
  arguments.output = output->path();
  if (const Status opened = open_inputs({arguments.input}); !opened) return fail(opened.error());
  if (const Status writable = check_output(arguments.output, {arguments.input}); !writable) {
    return fail(writable.error());
  }
  const InterruptedFiles unfinished({arguments.output}, nullptr);
  ConsoleProgress progress;
  auto summary = export_file(arguments, progress);
  progress.finish();
  if (!summary) return fail(summary.error());
  summary->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  arguments.output = named;
  return arguments.json ? output->finish_json(as_json(*summary, arguments))
                        : output->finish(as_text(*summary, arguments));
}

}  // namespace

void add_export(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("export", "Write patches as points or as a mesh");
  const auto arguments = std::make_shared<ExportArguments>();
  sub->add_option("PATCHES", arguments->input,
                  "Patch file (.relief), or a scan, mesh or raster, which is converted in memory; "
                  "-: standard "
                  "input")
      ->required()
      ->option_text("FILE");
  sub->add_option("-o,--output", arguments->output,
                  "File to write (.ply, .obj or .glb); -: a PLY to standard output")
      ->required()
      ->check([](const std::string& name) {
        return format_of(name) != nullptr || name == kStandardName
                   ? std::string()
                   : "expected a name that ends in .ply, .obj or .glb; found " + name;
      })
      ->option_text("FILE (required)");
  sub->add_option("--as", arguments->as,
                  "What to write (default: points in a .ply, mesh in an .obj or .glb)")
      ->check(CLI::IsMember({"mesh", "points"}))
      ->option_text("mesh|points");
  add_read_options(*sub, arguments->read);
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kExportExamples);
  sub->callback([arguments, &command] {
    check_json(arguments->output, arguments->json);
    command = [arguments] { return run_export(*arguments); };
  });
}

}  // namespace relief::cli
