// The options about colours by a scalar.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "common/scalars/colour_scale.h"

namespace relief::cli {

struct ColourArguments {
  std::optional<std::string> scalar;
  std::optional<ColourMap> map;
  std::optional<ColourRange> range;
  bool legend = true;
};

/// Declares --colour-by, --colour-map, --colour-range and --no-legend.
void add_colour_options(CLI::App& sub, ColourArguments& arguments);

/// What they ask for; nothing without --colour-by.
[[nodiscard]] std::optional<ColourBy> colour_by_of(const ColourArguments& arguments);

}  // namespace relief::cli
