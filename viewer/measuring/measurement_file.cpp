#include "viewer/measuring/measurement_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common/io/extension.h"
#include "common/io/file.h"

namespace relief {
namespace {

using Json = nlohmann::ordered_json;

/// What is measured of any kind but a point, whose values are its own coordinates.
constexpr std::array<std::string_view, 4> kValueNames{"length", "horizontal_length", "height",
                                                      "angle_degrees"};

Json as_json(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}

Json as_json(const SurfacePoint& point) {
  Json json{{"position", as_json(point.position)}, {"normal", as_json(point.normal)}};
  json["colour"] =
      point.colour ? Json{point.colour->r, point.colour->g, point.colour->b} : Json(nullptr);
  json["patch"] = point.patch ? Json(*point.patch) : Json(nullptr);
  json["uv"] = {point.uv.x, point.uv.y};
  return json;
}

/// A field of a table, in quotes where it needs them.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

/// The fields of what was measured, empty where that is nothing.
std::string value_fields(const std::vector<MeasuredValue>& values) {
  std::string fields;
  for (const std::string_view name : kValueNames) {
    fields += ',';
    const auto found = std::ranges::find(values, name, &MeasuredValue::name);
    if (found != values.end()) fields += fmt::format("{}", found->value);
  }
  return fields;
}

}  // namespace

std::string measurements_as_json(std::span<const Measurement> measurements,
                                 const MeasurementSource& model) {
  Json list = Json::array();
  for (const Measurement& measurement : measurements) {
    if (!is_complete(measurement)) continue;
    Json entry{{"name", measurement.name}, {"kind", name_of(measurement.kind)}};
    for (const MeasuredValue& value : values_of(measurement, model.up)) {
      if (measurement.kind != MeasurementKind::Point) entry[std::string(value.name)] = value.value;
    }
    entry["points"] = Json::array();
    for (const SurfacePoint& point : measurement.points) entry["points"].push_back(as_json(point));
    list.push_back(std::move(entry));
  }
  const Json json{{"version", 1},
                  {"file", model.file},
                  {"up", as_json(model.up)},
                  {"measurements", std::move(list)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string measurements_as_csv(std::span<const Measurement> measurements,
                                const MeasurementSource& model) {
  std::string table =
      "measurement,name,kind,point,x,y,z,normal_x,normal_y,normal_z,red,green,blue,patch";
  for (const std::string_view name : kValueNames) table += fmt::format(",{}", name);
  table += '\n';
  std::size_t number = 0;
  for (const Measurement& measurement : measurements) {
    if (!is_complete(measurement)) continue;
    ++number;
    std::vector<MeasuredValue> values = values_of(measurement, model.up);
    for (std::size_t k = 0; k < measurement.points.size(); ++k) {
      const SurfacePoint& point = measurement.points[k];
      const glm::dvec3& p = point.position;
      const glm::dvec3& n = point.normal;
      table += fmt::format("{},{},{},{},{},{},{},{},{},{},", number, csv_field(measurement.name),
                           name_of(measurement.kind), k + 1, p.x, p.y, p.z, n.x, n.y, n.z);
      table += point.colour
                   ? fmt::format("{},{},{}", point.colour->r, point.colour->g, point.colour->b)
                   : ",,";
      table += fmt::format(",{}{}\n", point.patch ? std::to_string(*point.patch) : std::string(),
                           value_fields(values));
      values.clear();
    }
  }
  return table;
}

Status write_measurements(const std::filesystem::path& path,
                          std::span<const Measurement> measurements,
                          const MeasurementSource& model) {
  const std::string kind = lower_extension(path);
  if (kind != ".json" && kind != ".csv") {
    return make_error("{}: measurements are written as .json or .csv; choose one of these",
                      path.string());
  }
  const std::string text = kind == ".json" ? measurements_as_json(measurements, model)
                                           : measurements_as_csv(measurements, model);
  return write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace relief
