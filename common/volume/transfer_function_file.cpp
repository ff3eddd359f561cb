// Files of transfer functions (docs/volumes.md).
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/image/srgb.h"
#include "common/io/file.h"
#include "common/scene/json/json_text.h"
#include "common/scene/json/json_values.h"
#include "common/volume/transfer_function.h"

namespace relief {
namespace {

constexpr std::size_t kMaxStops = 4096;
constexpr std::size_t kMaxBytes = 1 << 20;
constexpr double kMaxValue = 1e30;

/// Numbers of each stop: its place, which ascends, and what it has there.
std::vector<std::vector<double>> read_stops(JsonValues& values, const JsonNode& node,
                                            std::size_t numbers, double max,
                                            std::string_view expected) {
  std::vector<std::vector<double>> stops;
  for (const JsonNode& element : values.elements(node, kMaxStops, "stops")) {
    auto stop = values.numbers(element, {numbers, numbers}, {-kMaxValue, kMaxValue}, expected);
    if (stop.empty()) return {};
    for (std::size_t k = 1; k < stop.size(); ++k) {
      if (!(stop[k] >= 0.0 && stop[k] <= max)) {
        values.refuse_value(element, expected);
        return {};
      }
    }
    if (!stops.empty() && !(stop.front() > stops.back().front())) {
      values.refuse(element.path, "the stops' values ascend; this one is not above the one before");
      return {};
    }
    stops.push_back(std::move(stop));
  }
  return stops;
}

TransferFunction make_function(JsonValues& values, const JsonNode& root, double unit_length) {
  TransferFunction function;
  function.unit_length = unit_length;
  if (!values.object(root, {"colour", "opacity", "gradient_opacity", "unit_length"}))
    return function;
  if (const auto found = values.required(root, "colour", "a list of [value, r, g, b]")) {
    const auto stops =
        read_stops(values, *found, 4, 1.0, "[value, r, g, b], encoded sRGB, each from 0 to 1");
    for (const auto& s : stops) {
      function.colours.push_back(
          {s[0],
           {linear_from_srgb(static_cast<float>(s[1])), linear_from_srgb(static_cast<float>(s[2])),
            linear_from_srgb(static_cast<float>(s[3]))}});
    }
  }
  if (const auto found = values.required(root, "opacity", "a list of [value, opacity]")) {
    const auto stops = read_stops(values, *found, 2, kMaxOpacity,
                                  "[value, opacity], the opacity from 0 to 0.9999");
    for (const auto& s : stops) function.opacities.push_back({s[0], s[1]});
  }
  if (const auto found = JsonValues::member(root, "gradient_opacity")) {
    const auto stops =
        read_stops(values, *found, 2, 1.0, "[magnitude, factor], the factor from 0 to 1");
    for (const auto& s : stops) function.gradients.push_back({s[0], s[1]});
  }
  if (const auto found = JsonValues::member(root, "unit_length"))
    function.unit_length =
        values.number(*found, {1e-12, 1e12}, "a length in world units from 1e-12 to 1e12");
  return function;
}

}  // namespace

Result<TransferFunction> read_transfer_function(const std::filesystem::path& path,
                                                double default_unit_length) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(path));
  if (file.size() == 0 || file.size() > kMaxBytes) {
    return make_error("{}: has {} bytes; a transfer function has 1 to {}", path.string(),
                      file.size(), kMaxBytes);
  }
  std::string text(file.size(), '\0');
  RELIEF_TRY(file.read_at(0, std::as_writable_bytes(std::span<char>(text))));
  RELIEF_TRY_ASSIGN(const auto tree, parse_json(text, path.string()));
  JsonValues values(path.string());
  TransferFunction function = make_function(values, {tree, ""}, default_unit_length);
  if (values.error()) return *values.error();
  return function;
}

}  // namespace relief
