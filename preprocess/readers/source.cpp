#include "preprocess/readers/source.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "common/scalar.h"

namespace relief {
namespace {

/// "it has intensity, time": some of many.
std::string list_scalars(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  if (names.empty()) return "it has none";
  const auto some = std::span(names).first(std::min(names.size(), kMost));
  return fmt::format("it has {}{}", fmt::join(some, ", "),
                     names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "");
}

}  // namespace

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

Status check_scalars(const std::string& name, const ScalarChoice& choice,
                     const ReadRemarks& remarks) {
  for (const std::string& wanted : choice.names) {
    if (std::ranges::find(remarks.scalars, wanted) == remarks.scalars.end()) {
      return make_error("{}: has no scalar {}; {}", name, relief::quoted(wanted),
                        list_scalars(remarks.scalars));
    }
  }
  return {};
}

void drop_infinite(std::vector<PointScalar>& scalars) {
  for (PointScalar& scalar : scalars) {
    for (double& value : scalar.values) {
      if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
    }
  }
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
