#include "cli/reports/render_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/reports/explain_report.h"
#include "cli/reports/json_values.h"
#include "cli/reports/option_values.h"
#include "common/median.h"
#include "renderer/shading/materials.h"

namespace relief::cli {
namespace {

/// "lit", or "glass+lit" for an image with several.
std::string material_names(const RenderSettings& settings) {
  std::string names;
  for (const Named<Material>& named : kMaterials) {
    if (!uses(settings, named.value)) continue;
    if (!names.empty()) names += '+';
    names += named.name;
  }
  return names;
}

double median_frame_ms(const std::vector<WrittenImage>& written) {
  std::vector<double> times;
  times.reserve(written.size());
  for (const WrittenImage& image : written) times.push_back(image.result.frame_ms);
  return median_of(times);
}

std::string map_name(ColourMap map) {
  for (const Named<ColourMap>& named : kColourMaps) {
    if (named.value == map) return std::string(named.name);
  }
  return {};
}

nlohmann::ordered_json colours_as_json(const ColourScale& scale) {
  if (scale.is_label) return {{"scalar", scale.name}, {"labels", scale.labels}};
  return {{"scalar", scale.name},
          {"low", scale.low},
          {"high", scale.high},
          {"map", map_name(scale.map)}};
}

std::string colours_as_text(const ColourScale& scale) {
  if (scale.is_label)
    return fmt::format("  coloured by     {}: {}\n", scale.name, fmt::join(scale.labels, ", "));
  return fmt::format("  coloured by     {}: {:.9g} to {:.9g}, {}\n", scale.name, scale.low,
                     scale.high, map_name(scale.map));
}

nlohmann::ordered_json passes_as_json(const std::vector<PassTime>& passes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const PassTime& pass : passes) json.push_back({{"pass", pass.name}, {"ms", pass.ms}});
  return json;
}

std::string passes_as_text(const std::vector<PassTime>& passes) {
  if (passes.empty()) return {};
  std::vector<std::string> texts;
  texts.reserve(passes.size());
  for (const PassTime& pass : passes)
    texts.push_back(fmt::format("{} {:.2f} ms", pass.name, pass.ms));
  return fmt::format("  passes          {}\n", fmt::join(texts, ", "));
}

}  // namespace

nlohmann::ordered_json as_json(const WrittenImage& written) {
  const RenderSettings& settings = written.settings;
  const RenderResult& result = written.result;
  nlohmann::ordered_json json = {{"engine", settings.engine}};
  json.update(options_as_json(settings));
  json.update(
      {{"material", material_names(settings)},
       {"renderer", result.renderer},
       {"width", result.image.width},
       {"height", result.image.height},
       {"orthographic_height", settings.camera.is_orthographic()
                                   ? nlohmann::ordered_json(settings.camera.orthographic_height)
                                   : nlohmann::ordered_json(nullptr)},
       {"frame_ms", result.frame_ms},
       {"gpu_ms", value_or_null(result.gpu_ms)},
       {"covered_pixels", result.covered_pixels},
       {"fragments", value_or_null(result.fragments)},
       {"level", value_or_null(result.level)}});
  if (written.colours) json["colour_by"] = colours_as_json(*written.colours);
  if (settings.pass_frames > 0) json["passes"] = passes_as_json(result.passes);
  if (settings.explain)
    json["explain"] =
        result.explanation ? as_json(*result.explanation, written.read) : nlohmann::ordered_json();
  return json;
}

nlohmann::ordered_json scene_as_json(const std::vector<WrittenImage>& written) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const WrittenImage& image : written) {
    nlohmann::ordered_json view = {{"name", image.view}, {"output", image.file.string()}};
    view.update(as_json(image));
    views.push_back(std::move(view));
  }
  return {{"views", std::move(views)}};
}

nlohmann::ordered_json film_as_json(const std::vector<WrittenImage>& written) {
  nlohmann::ordered_json json = {{"output", written.front().file.string()},
                                 {"frames", written.size()}};
  json.update(as_json(written.front()));
  json["frame_ms"] = median_frame_ms(written);
  return json;
}

std::string film_as_text(const std::vector<WrittenImage>& written) {
  WrittenImage first = written.front();
  first.result.frame_ms = median_frame_ms(written);
  return as_text(first) + fmt::format("  frames          {}\n", written.size());
}

std::string as_text(const WrittenImage& written) {
  const RenderSettings& settings = written.settings;
  const RenderResult& result = written.result;
  const std::string fragments =
      result.fragments ? fmt::format("{}", *result.fragments) : std::string("not counted");
  const std::string colours = written.colours ? colours_as_text(*written.colours) : std::string();
  const std::string text = fmt::format(
      "{}\n"
      "  engine          {}: {}\n"
      "  material        {}\n"
      "{}"
      "  renderer        {}\n"
      "  size            {}x{}\n"
      "  frame           {:.2f} ms\n"
      "  covered pixels  {}\n"
      "  fragments       {}\n"
      "{}",
      written.file.string(), settings.engine, fmt::join(options_as_text(settings), ", "),
      material_names(settings), colours, result.renderer, result.image.width, result.image.height,
      result.frame_ms, result.covered_pixels, fragments, passes_as_text(result.passes));
  return result.explanation ? text + as_text(*result.explanation, written.read) : text;
}

}  // namespace relief::cli
