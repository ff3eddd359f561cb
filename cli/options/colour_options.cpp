#include "cli/options/colour_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "cli/options/values.h"
#include "common/scalars/scalar_names.h"

namespace relief::cli {
namespace {

constexpr const char* kRangeOption = "--colour-range";

RangeEnd parse_end(std::string_view text) {
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.remove_suffix(1);
  const std::optional<double> number = parse_number(text);
  const bool good =
      number && (is_percent ? *number >= 0.0 && *number <= 100.0 : std::abs(*number) <= 1e100);
  if (!good) {
    throw CLI::ValidationError(
        kRangeOption, fmt::format("{}{} is neither a number nor a percentage from 0% to 100%", text,
                                  is_percent ? "%" : ""));
  }
  return {*number, is_percent};
}

/// "LO,HI": numbers, or percentages such as 2%.
ColourRange parse_colour_range(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw CLI::ValidationError(kRangeOption, "expected LO,HI; found " + text);
  const std::string_view whole = text;
  const ColourRange range{parse_end(whole.substr(0, comma)), parse_end(whole.substr(comma + 1))};
  if (range.low.is_percent == range.high.is_percent && !(range.low.number < range.high.number))
    throw CLI::ValidationError(kRangeOption,
                               "its first end must be below its second; found " + text);
  return range;
}

}  // namespace

void add_colour_options(CLI::App& sub, ColourArguments& arguments) {
  auto* const colour_by =
      sub.add_option_function<std::string>(
             "--colour-by",
             [&arguments](const std::string& text) {
               arguments.scalar = canonical_scalar_name(text);
             },
             "Colour by a scalar of the scan: height, distance (to the nearest point), intensity, "
             "classification, return_number or any other; a patch file needs `relief convert "
             "--scalars` for all but height (default: by the scan's own colours)")
          ->check([](const std::string& text) {
            return text.empty() ? "expected the name of a scalar; found none" : std::string();
          })
          ->option_text("NAME");
  sub.add_option_function<std::string>(
         "--colour-map",
         [&arguments](const std::string& text) { arguments.map = find_named(kColourMaps, text); },
         "Colours of --colour-by, from low to high (default viridis; labels such as classes have "
         "colours of their own)")
      ->check([](const std::string& text) {
        return find_named(kColourMaps, text)
                   ? std::string()
                   : "expected " + list_names(kColourMaps, ", ") + "; found " + text;
      })
      ->option_text(list_names(kColourMaps, "|"))
      ->needs(colour_by);
  sub.add_option_function<std::string>(
         "--colour-range",
         [&arguments](const std::string& text) { arguments.range = parse_colour_range(text); },
         "Values of the first and the last colour, each a number, or the percentage of values "
         "below it (default 2%,98%)")
      ->option_text("LO,HI")
      ->needs(colour_by);
  sub.add_flag_callback(
         "--no-legend", [&arguments] { arguments.legend = false; },
         "Leave out the legend of --colour-by, which a .png or film has in a corner")
      ->needs(colour_by);
}

std::optional<ColourBy> colour_by_of(const ColourArguments& arguments) {
  if (!arguments.scalar) return std::nullopt;
  ColourBy colour_by;
  colour_by.scalar = *arguments.scalar;
  colour_by.map = arguments.map;
  colour_by.range = arguments.range;
  return colour_by;
}

}  // namespace relief::cli
