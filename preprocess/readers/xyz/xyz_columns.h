// Determines the meaning of columns in text files without a format description.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "preprocess/readers/point_record.h"

namespace relief {

/// Numbers by rows; all rows have the same number of columns.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> numbers;
  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : numbers.size() / columns; }
  [[nodiscard]] const double* row(std::size_t i) const { return numbers.data() + i * columns; }
};

struct ColumnRoles {
  std::vector<Role> roles;  ///< per column
  ColourNumbers colour_numbers = ColourNumbers::Integer;
  std::vector<std::string> names;  ///< per column, of those that are scalars
};

/// Gives each column its role.
/// 1. Names, if the line before the numbers has one for each column, x, y and z among them.
/// 2. Otherwise the first three columns are x, y and z. Each later group of three is tried, from
///    left to right, one column further if nothing matches:
///    - integers from 0 to 65535, not all of them 0 or 1: a colour;
///    - vectors of length 1 (within 5 %, in 9 of 10 rows that are not 0): a normal;
///    - numbers from 0 to 1: a colour.
/// Other columns (intensity, classification, time) are scalars, named as in that line, or column4,
/// column5 ... without one.
/// `extension` decides ambiguous cases: `.xyzn` has normals, `.xyzrgb` colours, and the fourth of
/// four or seven columns of `.pts` is the intensity.
[[nodiscard]] ColumnRoles find_column_roles(const NumberTable& table, std::string_view names,
                                            std::string_view extension);

}  // namespace relief
