#include "renderer/gl/shader/feature_names.h"

#include <bit>
#include <charconv>
#include <map>
#include <string_view>

#include "common/error.h"
#include "renderer/gl/shader/shader_text.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Names by bit, read from the header that the shaders are compiled with, so that no second list
/// can fall behind it.
std::map<std::uint32_t, std::string> read_names() {
  constexpr std::string_view kDefine = "#define RELIEF_FEATURE_";
  std::map<std::uint32_t, std::string> names;
  std::string_view text = find_shader("include/shared.h");
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!line.starts_with(kDefine)) continue;
    line.remove_prefix(kDefine.size());
    const std::string_view name = line.substr(0, line.find(' '));
    const std::string_view value = line.substr(std::min(name.size() + 1, line.size()));
    std::uint32_t bit = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), bit);
    if (error != std::errc() || !std::has_single_bit(bit)) continue;
    std::string& lower = names[bit];
    for (const char c : name) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return names;
}

}  // namespace

std::vector<std::string> feature_names(Features features) {
  std::map<std::uint32_t, std::string> names = read_names();
  std::vector<std::string> found;
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1U) {
    if (features.has(bit)) found.push_back(names[bit]);
  }
  if (features.lights > 0) found.push_back(fmt::format("lights {}", features.lights));
  return found;
}

}  // namespace relief
