#include "cli/render_report.h"

#include <fmt/format.h>

#include <optional>

namespace relief::cli {
namespace {

template <class T>
nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

nlohmann::ordered_json as_json(const WrittenPicture& written) {
  const auto& [settings, result] = written;
  return {{"engine", name_of(kEngines, settings.engine)},
          {"primitive", name_of(kPrimitives, settings.primitive)},
          {"interpolation", name_of(kInterpolations, settings.interpolation)},
          {"material", name_of(kMaterials, settings.material)},
          {"renderer", result.renderer},
          {"width", result.image.width},
          {"height", result.image.height},
          {"frame_ms", result.frame_ms},
          {"gpu_ms", value_or_null(result.gpu_ms)},
          {"covered_pixels", result.covered_pixels},
          {"fragments", value_or_null(result.fragments)}};
}

nlohmann::ordered_json scene_as_json(const RenderPlan& plan,
                                     const std::vector<WrittenPicture>& written) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < written.size(); ++i) {
    nlohmann::ordered_json view = {{"name", plan.pictures[i].view},
                                   {"output", plan.pictures[i].output.string()}};
    view.update(as_json(written[i]));
    views.push_back(std::move(view));
  }
  return {{"views", std::move(views)}};
}

std::string as_text(const Picture& picture, const WrittenPicture& written) {
  const auto& [settings, result] = written;
  const std::string fragments =
      result.fragments ? fmt::format("{}", *result.fragments) : std::string("not counted");
  return fmt::format(
      "{}\n"
      "  engine          {}, {}, {}, {}\n"
      "  renderer        {}\n"
      "  size            {}x{}\n"
      "  frame           {:.2f} ms\n"
      "  covered pixels  {}\n"
      "  fragments       {}\n",
      picture.output.string(), name_of(kEngines, settings.engine),
      name_of(kPrimitives, settings.primitive), name_of(kInterpolations, settings.interpolation),
      name_of(kMaterials, settings.material), result.renderer, result.image.width,
      result.image.height, result.frame_ms, result.covered_pixels, fragments);
}

}  // namespace relief::cli
