// From the values of a scalar to colours: what an image is coloured by, and what its legend shows.
#pragma once

#include <cstdint>
#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/scalar.h"
#include "common/scalars/colour_map.h"

namespace relief {

/// An end of a range: a value, or the percentage of values below it.
struct RangeEnd {
  double number = 0.0;
  bool is_percent = false;
};

struct ColourRange {
  RangeEnd low{2.0, true};
  RangeEnd high{98.0, true};
};

/// What to colour by. A label is coloured like a number if it has a map or a range.
struct ColourBy {
  std::string scalar;  ///< canonical name, or kHeightScalar or kDistanceScalar
  std::optional<ColourMap> map = {};
  std::optional<ColourRange> range = {};
  std::optional<glm::dvec3> up =
      {};  ///< heights are along it, of any length but 0; none: the model's
};

/// The colours of a scalar's values.
struct ColourScale {
  std::string name;
  bool is_label = false;    ///< labels have colours of their own
  bool has_labels = false;  ///< its values are labels, coloured like numbers or not
  ColourMap map = ColourMap::Viridis;
  double low = 0.0;  ///< the value of the map's first colour; values below have it, too
  double high = 1.0;
  std::vector<std::uint32_t> labels;  ///< those that occur, ascending

  /// Returns the colour of a value, 8-bit sRGB.
  [[nodiscard]] glm::u8vec3 at(double value) const;
};

/// Returns the scalar's name in words.
[[nodiscard]] std::string title_of(const ColourScale& scale);

/// Returns a label, and the meaning that it has in LAS files if they are its scalar's: "2  Ground".
[[nodiscard]] std::string label_text(const ColourScale& scale, std::uint32_t label);

/// Makes a scale for a scalar of these quantiles. Fails if the range is empty, as a clause.
[[nodiscard]] Result<ColourScale> make_colour_scale(const ColourBy& colour_by, bool has_labels,
                                                    const Quantiles& quantiles);

}  // namespace relief
