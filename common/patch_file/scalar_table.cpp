#include "common/patch_file/scalar_table.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/io/bytes.h"

namespace relief {
namespace {

constexpr std::uint8_t kLabelFlag = 1;

std::string find_fault(const ScalarInfo& scalar) {
  const bool is_printable =
      std::ranges::all_of(scalar.name, [](char c) { return c > ' ' && c < '\x7F'; });
  if (scalar.name.empty() || scalar.name.size() > kMaxScalarName || !is_printable)
    return "its name is empty, too long or not printable";
  if (!std::isfinite(scalar.offset) || !std::isfinite(scalar.value_of(kMaxScalarCode)) ||
      !(scalar.step > 0.0))
    return "its range is not finite";
  const double last = scalar.value_of(kMaxScalarCode);
  if (scalar.is_label && !(scalar.offset >= 0.0 && scalar.offset == std::floor(scalar.offset) &&
                           scalar.step == 1.0 && last <= 2.0 * kMaxScalarCode))
    return "its values are no labels";
  if (!std::ranges::is_sorted(scalar.quantiles) || scalar.quantiles.back() > kMaxScalarCode)
    return "its quantiles do not ascend";
  return {};
}

}  // namespace

std::string find_fault(std::span<const ScalarInfo> scalars) {
  if (scalars.size() > kMaxScalars)
    return fmt::format("there are {} scalars, more than {}", scalars.size(), kMaxScalars);
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    if (const std::string fault = find_fault(scalars[k]); !fault.empty())
      return fmt::format("scalar {}: {}", k, fault);
    const auto same = std::ranges::find(scalars.first(k), scalars[k].name, &ScalarInfo::name);
    if (same != scalars.first(k).end())
      return fmt::format("two scalars are named {}", scalars[k].name);
  }
  return {};
}

std::vector<std::byte> write_scalar_table(std::span<const ScalarInfo> scalars) {
  std::vector<std::byte> out;
  append_number(out, static_cast<std::uint8_t>(scalars.size()));
  for (const ScalarInfo& scalar : scalars) {
    append_number(out, static_cast<std::uint8_t>(scalar.name.size()));
    for (const char c : scalar.name) append_number(out, static_cast<std::uint8_t>(c));
    append_number(out, scalar.is_label ? kLabelFlag : std::uint8_t{0});
    append_number(out, scalar.offset);
    append_number(out, scalar.step);
    for (const std::uint16_t code : scalar.quantiles) append_number(out, code);
  }
  return out;
}

Result<std::vector<ScalarInfo>> parse_scalar_table(std::span<const std::byte> bytes) {
  constexpr std::size_t kAfterName =
      1 + 2 * sizeof(double) + std::tuple_size_v<decltype(ScalarInfo::quantiles)> * 2;
  ByteReader in(bytes);
  const auto ended = [] { return make_error("the table of scalars ends early"); };
  if (in.left() == 0) return ended();
  const auto count = in.take<std::uint8_t>();
  std::vector<ScalarInfo> scalars;
  for (unsigned k = 0; k < count; ++k) {
    if (in.left() == 0) return ended();
    const auto length = in.take<std::uint8_t>();
    if (in.left() < length + kAfterName) return ended();
    ScalarInfo scalar;
    for (unsigned c = 0; c < length; ++c) scalar.name += static_cast<char>(in.take<std::uint8_t>());
    const auto flags = in.take<std::uint8_t>();
    if (flags > kLabelFlag) return make_error("scalar {} has unknown flags", k);
    scalar.is_label = flags == kLabelFlag;
    scalar.offset = in.take<double>();
    scalar.step = in.take<double>();
    for (std::uint16_t& code : scalar.quantiles) code = in.take<std::uint16_t>();
    scalars.push_back(std::move(scalar));
  }
  if (in.left() > 0) return make_error("bytes follow the table of scalars");
  if (const std::string fault = find_fault(scalars); !fault.empty()) return Error{fault};
  return scalars;
}

}  // namespace relief
