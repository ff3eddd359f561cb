#include "common/scalars/colour_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "common/scalars/quantise.h"
#include "common/scalars/scalar_names.h"

namespace relief {
namespace {

double value_of(const RangeEnd& end, const Quantiles& quantiles) {
  return end.is_percent ? at_percent(quantiles, end.number) : end.number;
}

}  // namespace

glm::u8vec3 ColourScale::at(double value) const {
  if (is_label) {
    const auto label = static_cast<std::uint32_t>(value);
    return name == "classification" ? las_class_colour(label) : label_colour(label);
  }
  // A range of one value: all have the middle of the map.
  if (!(high > low)) return colour_at(map, 0.5);
  return colour_at(map, value / (high - low) - low / (high - low));
}

std::string title_of(const ColourScale& scale) {
  std::string title = scale.name;
  std::ranges::replace(title, '_', ' ');
  return title;
}

std::string label_text(const ColourScale& scale, std::uint32_t label) {
  const auto name = scale.name == "classification" ? las_class_name(label) : std::string_view();
  return name.empty() ? fmt::format("{}", label) : fmt::format("{}  {}", label, name);
}

Result<ColourScale> make_colour_scale(const ColourBy& colour_by, bool has_labels,
                                      const Quantiles& quantiles) {
  ColourScale scale;
  scale.name = colour_by.scalar;
  scale.has_labels = has_labels;
  scale.is_label = has_labels && !colour_by.map && !colour_by.range;
  scale.map = colour_by.map.value_or(ColourMap::Viridis);
  const ColourRange range = colour_by.range.value_or(ColourRange());
  scale.low = value_of(range.low, quantiles);
  scale.high = value_of(range.high, quantiles);
  if (scale.low > scale.high) {
    return make_error(
        "the range of {} is empty: it is {:g} to {:g}, and its values are {:g} to {:g}", scale.name,
        scale.low, scale.high, quantiles.front(), quantiles.back());
  }
  return scale;
}

}  // namespace relief
