#include "cli/options/read_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <string>

#include "cli/options/values.h"
#include "common/scalars/scalar_names.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/format.h"

namespace relief::cli {
namespace {

constexpr unsigned kMostClasses = 256;
constexpr unsigned kMostReturns = 15;

void read_classes(const std::string& text, PointSelection& selection) {
  for (const std::string_view part : split(text, ',')) {
    const auto number = parse_whole(part);
    if (!number || *number >= kMostClasses) {
      throw CLI::ValidationError(
          "--classes",
          "expected classes from 0 to 255, separated by commas, as in 2,6; found " + text);
    }
    selection.classes.set(*number);
  }
}

void read_returns(const std::string& text, PointSelection& selection) {
  if (text == "first") {
    selection.returns = ReturnChoice::First;
  } else if (text == "last") {
    selection.returns = ReturnChoice::Last;
  } else if (text == "single") {
    selection.returns = ReturnChoice::Single;
  } else if (const auto number = parse_whole(text);
             number && *number >= 1 && *number <= kMostReturns) {
    selection.returns = ReturnChoice::Numbered;
    selection.return_number = *number;
  } else {
    throw CLI::ValidationError(
        "--returns", "expected first, last, single or a number from 1 to 15; found " + text);
  }
}

void read_crop(const std::string& text, PointSelection& selection) {
  const auto n = parse_numbers(text);
  const bool has_z = n.size() == 6;
  if ((n.size() != 4 && !has_z) || n[0] > n[2] || n[1] > n[3] || (has_z && n[4] > n[5])) {
    throw CLI::ValidationError(
        "--crop",
        "expected X0,Y0,X1,Y1 or X0,Y0,X1,Y1,Z0,Z1, the lower value first; found " + text);
  }
  constexpr double inf = std::numeric_limits<double>::infinity();
  selection.crop = Bounds{{n[0], n[1], has_z ? n[4] : -inf}, {n[2], n[3], has_z ? n[5] : inf}};
}

/// Every extension of every format, "ply|pcd|...".
std::string format_names() {
  std::string names;
  for (const PointFormat& format : point_formats()) names += fmt::format("{}|", format.target());
  return fmt::format("{}{}|{}", names, kGridFormat, kRasterFormat);
}

}  // namespace

void add_read_options(CLI::App& sub, ReadOptions& options) {
  sub.add_option("--format", options.format,
                 "Format of the scan, for standard input or an extension that does not tell "
                 "(default: by content, then by extension)")
      ->check([](const std::string& name) {
        return format_named(name) != nullptr || name == kRasterFormat || name == kGridFormat
                   ? std::string()
                   : "expected one of " + format_names() + "; found " + name;
      })
      ->option_text(format_names());
  sub.add_option_function<std::string>(
         "--classes",
         [&options](const std::string& text) { read_classes(text, options.selection); },
         "LAS: read only points of these classes, 0 to 255, as in 2,6 (default: all but noise)")
      ->option_text("N,...");
  sub.add_option_function<std::string>(
         "--returns",
         [&options](const std::string& text) { read_returns(text, options.selection); },
         "LAS: read only these returns of each pulse; single: of pulses with one; N: 1 to 15 "
         "(default: all)")
      ->option_text("first|last|single|N");
  sub.add_option_function<std::string>(
         "--crop", [&options](const std::string& text) { read_crop(text, options.selection); },
         "Read only points in this box, in the scan's own coordinates, borders included "
         "(default: all)")
      ->option_text("X0,Y0,X1,Y1[,Z0,Z1]");
}

void add_raw_option(CLI::App& sub, VolumeReadOptions& options) {
  sub.add_option_function<std::string>(
         "--raw",
         [&options](const std::string& text) {
           auto layout = parse_raw_layout(text);
           if (!layout) throw CLI::ValidationError("--raw", layout.error().message);
           options.raw = *layout;
         },
         "Layout of a volume without a header, as in 256x256x109:u8 or 64x64x32:f32:be:1,1,2.5: "
         "size, "
         "type, byte order and spacing (default: the file has a header)")
      ->option_text("LAYOUT");
}

void add_volume_scalar_option(CLI::App& sub, VolumeReadOptions& options) {
  sub.add_option_function<std::string>(
         "--volume-scalar",
         [&options](const std::string& text) { options.scalar = canonical_scalar_name(text); },
         "Draw the scan's points as a volume whose value is this scalar of theirs (default: as a "
         "surface)")
      ->check([](const std::string& text) {
        return text.empty() ? "expected the name of a scalar; found none" : std::string();
      })
      ->option_text("NAME")
      ->excludes("--raw");
}

}  // namespace relief::cli
