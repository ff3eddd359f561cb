#include "preprocess/readers/xyz/xyz_columns.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "preprocess/readers/source.h"

namespace relief {
namespace {

/// The words of a header line in lower case, without comment marks and quotes.
std::vector<std::string> split_names(std::string_view line) {
  constexpr std::string_view between = " \t,;\"#/%";
  std::vector<std::string> names;
  for (std::size_t at = line.find_first_not_of(between); at != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    names.push_back(lower_case(line.substr(at, end - at)));
    at = line.find_first_not_of(between, end);
  }
  return names;
}

std::optional<ColumnRoles> roles_from_names(const NumberTable& table, std::string_view line) {
  const std::vector<std::string> names = split_names(line);
  if (names.size() != table.columns) return std::nullopt;
  RecordLayout layout;
  ColumnRoles found;
  for (const std::string& name : names) found.roles.push_back(layout.add(role_of(name)));
  if (!layout.positions()) return std::nullopt;
  found.names = names;
  return found;
}

/// The contents of three neighbouring columns.
enum class Triple { Nothing, Normal, IntegerColour, RealColour };

Triple classify(const NumberTable& table, std::size_t column) {
  bool integers = true;
  double smallest = 0.0;
  double largest = 0.0;
  std::size_t vectors = 0;
  std::size_t unit_vectors = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double* const v = table.row(i) + column;
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!std::isfinite(length)) continue;
    vectors += length > 0.0 ? 1 : 0;
    unit_vectors += std::abs(length - 1.0) < 0.05 ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      integers = integers && v[k] == std::floor(v[k]);
      smallest = std::min(smallest, v[k]);
      largest = std::max(largest, v[k]);
    }
  }
  if (integers && smallest >= 0.0 && largest > 1.0 && largest <= 65535.0)
    return Triple::IntegerColour;
  if (vectors > 0 && 10 * unit_vectors >= 9 * vectors) return Triple::Normal;
  if (smallest >= 0.0 && largest <= 1.0) return Triple::RealColour;
  return Triple::Nothing;
}

}  // namespace

ColumnRoles find_column_roles(const NumberTable& table, std::string_view names,
                              std::string_view extension) {
  const auto named = roles_from_names(table, names);
  ColumnRoles found = named.value_or(ColumnRoles{});
  if (named) {
    // The name gives the columns of the colour; their scale follows from the numbers.
    const auto red =
        static_cast<std::size_t>(std::ranges::find(found.roles, Red) - found.roles.begin());
    for (std::size_t i = 0; red < table.columns && i < table.rows(); ++i) {
      const double value = table.row(i)[red];
      if (value != std::floor(value)) found.colour_numbers = ColourNumbers::Real;
    }
    return found;
  }
  found.roles.assign(table.columns, Other);
  std::copy_n(std::begin({X, Y, Z}), 3, found.roles.begin());
  bool normal = false;
  bool colour = false;
  std::size_t column = extension == ".pts" && table.columns == 7 ? 4 : 3;
  while (column + 3 <= table.columns) {
    Triple triple = classify(table, column);
    if (extension == ".xyzn" && column == 3) triple = Triple::Normal;
    if (extension == ".xyzrgb" && column == 3 && triple != Triple::IntegerColour) {
      triple = Triple::RealColour;
    }
    if (triple == Triple::Normal && !normal) {
      normal = true;
      std::copy_n(std::begin({Nx, Ny, Nz}), 3,
                  found.roles.begin() + static_cast<std::ptrdiff_t>(column));
    } else if ((triple == Triple::IntegerColour || triple == Triple::RealColour) && !colour) {
      colour = true;
      std::copy_n(std::begin({Red, Green, Blue}), 3,
                  found.roles.begin() + static_cast<std::ptrdiff_t>(column));
      if (triple == Triple::RealColour) found.colour_numbers = ColourNumbers::Real;
    } else {
      ++column;
      continue;
    }
    column += 3;
  }
  for (std::size_t c = 0; c < table.columns; ++c)
    found.names.push_back(fmt::format("column{}", c + 1));
  const bool has_intensity = table.columns == 4 || table.columns == 7;
  if (extension == ".pts" && has_intensity) found.names[3] = "intensity";
  return found;
}

}  // namespace relief
