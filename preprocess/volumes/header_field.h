// A field of a text header, where errors point to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/error.h"

namespace relief {

/// The line of a file that has the field.
struct FieldPlace {
  const std::string& name;  ///< of the file
  std::size_t line = 0;     ///< from 1
};

/// Returns the error of a value that is not `expected`.
[[nodiscard]] Error wrong_field(const FieldPlace& place, std::string_view expected,
                                std::string_view found);

/// Parses the three sizes of a grid, each at least 1.
Status parse_sizes(const FieldPlace& place, std::string_view value,
                   std::array<std::int64_t, 3>& sizes);

}  // namespace relief
