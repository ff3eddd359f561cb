#include "cli/reports/render_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/reports/explain_report.h"
#include "cli/reports/json_values.h"
#include "renderer/engine_registry.h"
#include "renderer/frame/image_parts.h"
#include "renderer/shading/materials.h"

namespace relief::cli {
namespace {

/// What was chosen about the engine.
std::string way_of(const RenderSettings& settings) {
  if (settings.engine == "onepass") {
    return fmt::format("{}, {}", name_of(kPrimitives, settings.primitive),
                       name_of(kInterpolations, settings.interpolation));
  }
  if (settings.engine == "multipass") {
    return fmt::format("{}, radius factor {:g}", name_of(kPrimitives, settings.primitive),
                       settings.multipass.radius_factor);
  }
  if (settings.engine == "ewa") return std::string(name_of(kFilters, settings.ewa.filter));
  return fmt::format("{} samples a pixel", settings.raytrace.samples);
}

/// Samples that a pixel has; nothing of an engine that has none.
std::optional<std::uint64_t> samples_of(const RenderSettings& settings) {
  if (settings.engine == "raytrace") return static_cast<std::uint64_t>(settings.raytrace.samples);
  if (!needs_opengl(settings.engine)) return std::nullopt;
  const std::uint64_t side = samples_a_side(settings.samples);
  return side * side;
}

/// "lit", or "glass+lit" of a picture with several.
std::string material_names(const RenderSettings& settings) {
  std::string names;
  for (const Named<Material>& named : kMaterials) {
    if (!uses(settings, named.value)) continue;
    if (!names.empty()) names += '+';
    names += named.name;
  }
  return names;
}

}  // namespace

nlohmann::ordered_json as_json(const WrittenImage& written) {
  const RenderSettings& settings = written.settings;
  const RenderResult& result = written.result;
  const auto said_by = [](bool has, const auto& way) {
    return has ? nlohmann::ordered_json(way) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json json = {
      {"engine", settings.engine},
      {"primitive",
       said_by(needs_opengl(settings.engine), name_of(kPrimitives, settings.primitive))},
      {"interpolation",
       said_by(settings.engine == "onepass", name_of(kInterpolations, settings.interpolation))},
      {"pixels_per_sample", said_by(settings.engine == "onepass", pixels_per_sample_of(settings))},
      {"radius_factor", said_by(settings.engine == "multipass", settings.multipass.radius_factor)},
      {"samples", value_or_null(samples_of(settings))},
      {"material", material_names(settings)},
      {"renderer", result.renderer},
      {"width", result.image.width},
      {"height", result.image.height},
      {"orthographic_height",
       said_by(settings.camera.is_orthographic(), settings.camera.orthographic_height)},
      {"frame_ms", result.frame_ms},
      {"gpu_ms", value_or_null(result.gpu_ms)},
      {"covered_pixels", result.covered_pixels},
      {"fragments", value_or_null(result.fragments)},
      {"level", value_or_null(result.level)}};
  if (settings.explain)
    json["explain"] = result.explanation ? as_json(*result.explanation) : nlohmann::ordered_json();
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

std::string as_text(const WrittenImage& written) {
  const RenderSettings& settings = written.settings;
  const RenderResult& result = written.result;
  const std::string fragments =
      result.fragments ? fmt::format("{}", *result.fragments) : std::string("not counted");
  const std::string text = fmt::format(
      "{}\n"
      "  engine          {}, {}, {}\n"
      "  renderer        {}\n"
      "  size            {}x{}\n"
      "  frame           {:.2f} ms\n"
      "  covered pixels  {}\n"
      "  fragments       {}\n",
      written.file.string(), settings.engine, way_of(settings), material_names(settings),
      result.renderer, result.image.width, result.image.height, result.frame_ms,
      result.covered_pixels, fragments);
  return result.explanation ? text + as_text(*result.explanation) : text;
}

}  // namespace relief::cli
