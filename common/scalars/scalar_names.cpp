#include "common/scalars/scalar_names.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/scalar.h"

namespace relief {

std::string canonical_scalar_name(std::string_view name) {
  std::string lower;
  for (const char c : name) {
    const bool is_printable = c > ' ' && c < '\x7F';
    const char shown = is_printable ? c : '_';
    lower += shown >= 'A' && shown <= 'Z' ? static_cast<char>(shown - 'A' + 'a') : shown;
  }
  constexpr std::string_view kPrefix = "scalar_";
  if (lower.starts_with(kPrefix) && lower.size() > kPrefix.size()) lower.erase(0, kPrefix.size());
  lower.resize(std::min(lower.size(), kMaxScalarName));
  if (lower == "class") return "classification";
  if (lower == "return") return "return_number";
  if (lower == "returns") return "number_of_returns";
  return lower;
}

std::string file_scalar_name(std::string_view name) {
  std::string canonical = canonical_scalar_name(name);
  const bool is_computed = canonical == kHeightScalar || canonical == kDistanceScalar;
  return is_computed ? "file_" + canonical : canonical;
}

bool is_label_name(std::string_view name) {
  constexpr std::array kWords{"class",    "label",  "segment", "cluster",
                              "instance", "return", "ring",    "category"};
  const bool has_word = std::ranges::any_of(
      kWords, [name](const char* word) { return name.find(word) != name.npos; });
  return has_word || name == "id" || name.ends_with("_id") || name == "user_data";
}

bool are_labels(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double v) {
    return std::isnan(v) || (v >= 0.0 && v <= kMaxScalarCode && v == std::floor(v));
  });
}

std::string_view las_class_name(std::uint32_t value) {
  constexpr std::array<std::string_view, 23> kNames{"Never classified",
                                                    "Unclassified",
                                                    "Ground",
                                                    "Low vegetation",
                                                    "Medium vegetation",
                                                    "High vegetation",
                                                    "Building",
                                                    "Low noise",
                                                    "Model key point",
                                                    "Water",
                                                    "Rail",
                                                    "Road surface",
                                                    "Overlap",
                                                    "Wire, guard",
                                                    "Wire, conductor",
                                                    "Transmission tower",
                                                    "Wire connector",
                                                    "Bridge deck",
                                                    "High noise",
                                                    "Overhead structure",
                                                    "Ignored ground",
                                                    "Snow",
                                                    "Temporal exclusion"};
  return value < kNames.size() ? kNames[value] : std::string_view();
}

bool ScalarChoice::has(std::string_view canonical) const {
  return all || std::ranges::find(names, canonical) != names.end();
}

}  // namespace relief
