// The names of scalars, across formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relief {

/// Returns the name under which a scalar is known, whatever the format: lower case, without the
/// prefix "scalar_" of CloudCompare; "class" becomes classification, "return" return_number and
/// "returns" number_of_returns. Other bytes than printable ASCII become '_'; at most
/// kMaxScalarName bytes remain.
[[nodiscard]] std::string canonical_scalar_name(std::string_view name);

/// Returns the canonical name of a scalar that a file calls `name`. Those that are computed, height
/// and distance, become file_height and file_distance.
[[nodiscard]] std::string file_scalar_name(std::string_view name);

/// Returns whether a canonical name is one of labels: a class, label, segment, cluster, instance,
/// return, ring or id.
[[nodiscard]] bool is_label_name(std::string_view name);

/// Returns whether all numbers that are not NaN are whole and 0 to 65534, as labels are.
[[nodiscard]] bool are_labels(const std::vector<double>& values);

/// Returns the meaning of a value of `classification`, "Ground" (LAS 1.4 R15, table 17); empty if
/// the standard has none.
[[nodiscard]] std::string_view las_class_name(std::uint32_t value);

/// The scalars to read from a file.
struct ScalarChoice {
  bool all = false;
  std::vector<std::string> names;  ///< canonical

  [[nodiscard]] bool has(std::string_view canonical) const;
  [[nodiscard]] bool empty() const { return !all && names.empty(); }
};

}  // namespace relief
