#include "preprocess/readers/source.h"

#include <algorithm>

#include "common/scalar.h"

namespace relief {

const PointSelection& Source::selection() const {
  static const PointSelection all;
  return selected != nullptr ? *selected : all;
}

bool Source::takes_scalar(const std::string& canonical) const {
  std::vector<std::string>& known = remarks.scalars;
  if (std::ranges::find(known, canonical) != known.end()) return false;
  known.push_back(canonical);
  if (scalars == nullptr || !scalars->has(canonical)) return false;
  const auto kept =
      std::ranges::count_if(known, [this](const std::string& one) { return scalars->has(one); });
  return static_cast<std::size_t>(kept) <= kMaxScalars;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 24;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += (c >= ' ' && c <= '~') ? c : '?';
  return out + (text.size() > longest ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\f\v";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

Error too_many_points(const Source& source, std::uint64_t count) {
  return make_error("{}: has {} points, more than the {} that can be indexed; split it",
                    source.name, count, kNoPoint - 1);
}

}  // namespace relief
