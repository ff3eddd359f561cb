#include "preprocess/volumes/encoded_bytes.h"

#include <algorithm>
#include <array>

namespace relief {
namespace {

constexpr std::uint8_t kNoDigit = 255;
constexpr std::uint8_t kPadding = 254;
constexpr std::uint8_t kBlank = 253;

/// The value of each character in base64 (RFC 4648, section 4).
constexpr std::array<std::uint8_t, 256> base64_values() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t k = 0; k < digits.size(); ++k)
    values[static_cast<unsigned char>(digits[k])] = static_cast<std::uint8_t>(k);
  for (const char blank : {' ', '\t', '\r', '\n'})
    values[static_cast<unsigned char>(blank)] = kBlank;
  values['='] = kPadding;
  return values;
}

constexpr std::array<std::uint8_t, 256> kBase64Values = base64_values();

}  // namespace

bool EncodedBytes::take_group(std::byte (&group)[3]) {
  std::uint32_t bits = 0;
  int digits = 0;
  std::size_t at = 0;
  for (; digits < 4; ++at) {
    if (at == text_.size()) return false;
    const std::uint8_t value = kBase64Values[static_cast<unsigned char>(text_[at])];
    if (value == kBlank) continue;
    if (value == kNoDigit) return false;
    bits = bits << 6U | (value == kPadding ? 0U : value);
    ++digits;
  }
  text_.remove_prefix(at);
  for (unsigned k = 0; k < 3; ++k) group[k] = static_cast<std::byte>(bits >> (16 - 8 * k) & 0xFFU);
  return true;
}

bool EncodedBytes::take(std::uint64_t count, std::span<const std::byte>& bytes) {
  if (count > left()) return false;
  const auto size = static_cast<std::size_t>(count);
  if (!is_base64_) {
    bytes = std::as_bytes(std::span(text_.substr(0, size)));
    text_.remove_prefix(size);
    return true;
  }
  decoded_.resize(size);
  std::byte* out = decoded_.data();
  std::byte group[3];
  for (std::size_t left = size; left > 0;) {
    if (!take_group(group)) return false;
    const std::size_t used = std::min<std::size_t>(3, left);
    out = std::copy_n(group, used, out);
    left -= used;
  }
  bytes = decoded_;
  return true;
}

}  // namespace relief
