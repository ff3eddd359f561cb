// relief compare: measures how far an image is from a reference.
#include "common/compare/compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/limits.h"
#include "cli/options/paths.h"
#include "cli/options/values.h"
#include "cli/reports/comparison_report.h"
#include "common/compare/heatmap.h"
#include "common/image/image_io.h"
#include "common/io/extension.h"

namespace relief::cli {
namespace {

constexpr const char* kCompareExamples =
    "What can be measured depends on the channels: a PNG has colour and perhaps alpha, an EXR of\n"
    "`relief render` has all. A quantity that cannot be measured is null in JSON, and any limit on "
    "it\n"
    "fails. The PSNR of identical images is null, and passes any lower limit. KEY is the key of "
    "any\n"
    "number in the JSON object.\n"
    "\n"
    "Examples:\n"
    "  relief compare onepass.exr raytrace.exr\n"
    "  relief compare now.png golden.png --heatmap difference.png --fail-above flip_mean=0.001\n"
    "  relief compare now.exr truth.exr --fail-above holes=0 --fail-below psnr_db=40 --json";

struct CompareArguments {
  std::filesystem::path test;
  std::filesystem::path reference;
  std::filesystem::path heatmap;
  std::optional<FlipRange> range;
  double pixels_per_degree = kFlipPixelsPerDegree;
  std::vector<Limit> limits;
  bool json = false;
};

/// A PNG holds display values; only two images with radiance can be compared as radiance.
FlipOptions flip_options(const CompareArguments& arguments) {
  FlipOptions options;
  options.pixels_per_degree = arguments.pixels_per_degree;
  const bool png = is_png_file(arguments.test) || is_png_file(arguments.reference);
  options.range = arguments.range.value_or(png ? FlipRange::Ldr : FlipRange::Hdr);
  return options;
}

/// Reads, compares and writes the heatmap.
Result<Comparison> compare_files(const CompareArguments& arguments, const FlipOptions& options) {
  ConsoleProgress progress;
  RELIEF_TRY_ASSIGN(const auto test, read_image(arguments.test));
  RELIEF_TRY_ASSIGN(const auto reference, read_image(arguments.reference));
  auto comparison = compare_images(test, reference, options, progress);
  if (!comparison) {
    return make_error("{} against {}: {}", arguments.test.string(), arguments.reference.string(),
                      comparison.error().message);
  }
  if (!arguments.heatmap.empty()) {
    const Status written =
        write_png(arguments.heatmap,
                  make_heatmap(comparison->flip.map, comparison->width, comparison->height));
    if (!written) return written.error();
    InterruptedFiles::note_complete();
  }
  return comparison;
}

int run_compare(const CompareArguments& arguments) {
  if (!arguments.heatmap.empty()) {
    const Status writable = check_output(arguments.heatmap, {arguments.test, arguments.reference});
    if (!writable) return fail(writable.error());
  }
  const InterruptedFiles unfinished({arguments.heatmap}, nullptr);
  const FlipOptions options = flip_options(arguments);
  const auto comparison = compare_files(arguments, options);
  if (!comparison) return fail(comparison.error());
  const std::string title =
      fmt::format("{} against {}", arguments.test.string(), arguments.reference.string());
  const int printed = arguments.json ? print_json(as_json(*comparison, options))
                                     : print_result(title + "\n" + as_text(*comparison, options));
  if (printed != kDone) return printed;
  if (const auto broken = find_broken_limits(arguments.limits, *comparison)) {
    return fail(make_error("{}: {}", title, broken->message));
  }
  return kDone;
}

void add_limit_option(CLI::App& sub, CompareArguments& arguments, const char* name, Bound bound,
                      const char* help) {
  sub.add_option_function<std::vector<std::string>>(
         name,
         [&arguments, bound](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             arguments.limits.push_back(parse_limit(text, bound));
           }
         },
         help)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("KEY=VALUE");
}

}  // namespace

void add_compare(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("compare", "Compare an image with a reference");
  const auto arguments = std::make_shared<CompareArguments>();
  sub->add_option("A", arguments->test, "Image under test: EXR, PNG, JPEG or Radiance HDR")
      ->required()
      ->option_text("FILE");
  sub->add_option("B", arguments->reference, "Reference image, of the same size")
      ->required()
      ->option_text("FILE");
  sub->add_option("--heatmap", arguments->heatmap,
                  "PNG to write the FLIP error of each pixel to, as colours from black to pale "
                  "yellow (default: none)")
      ->check([](const std::string& name) {
        return lower_extension(name) == ".png" ? std::string()
                                               : "expected a name that ends in .png";
      })
      ->option_text("OUT.png");
  sub->add_option_function<std::string>(
         "--flip",
         [arguments](const std::string& name) {
           arguments->range = name == "hdr" ? FlipRange::Hdr : FlipRange::Ldr;
         },
         "Kind of FLIP: ldr compares what a display shows, hdr compares light (default: ldr if an "
         "image is a PNG, else hdr)")
      ->check(CLI::IsMember({"ldr", "hdr"}))
      ->option_text("ldr|hdr");
  sub->add_option(
         "--pixels-per-degree", arguments->pixels_per_degree,
         "Pixels in a degree of the observer's view, for FLIP, 1 to 1000 (default 67.02: 0.7 m "
         "from a display 0.7 m wide with 3840 pixels)")
      ->check([](const std::string& text) {
        const auto value = parse_number(text);
        return value && *value >= 1.0 && *value <= 1000.0
                   ? std::string()
                   : "expected a number from 1 to 1000; found " + text;
      })
      ->option_text("N");
  add_limit_option(
      *sub, *arguments, "--fail-below", Bound::Below,
      "Exit with code 1 if quantity KEY is below VALUE; may be repeated (default: no limit)");
  add_limit_option(
      *sub, *arguments, "--fail-above", Bound::Above,
      "Exit with code 1 if quantity KEY is above VALUE; may be repeated (default: no limit)");
  sub->add_flag("--json", arguments->json, "Print one JSON object on standard output");
  sub->footer(kCompareExamples);
  sub->callback(
      [arguments, &command] { command = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace relief::cli
