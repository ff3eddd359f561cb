// The report of `relief render` about the images that it wrote.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/reports/cost_report.h"
#include "common/scalars/colour_scale.h"
#include "renderer/render.h"

namespace relief::cli {

/// An image that was written: its view and file, the renderer's settings and result. The result's
/// image has no channels any more.
struct WrittenImage {
  std::string view;  ///< its name in the scene file; empty without one
  std::filesystem::path file;
  RenderSettings settings;
  RenderResult result;
  std::optional<ColourScale> colours;  ///< of --colour-by
  FileBytes read;                      ///< of the scene, all views together
};

/// Returns one JSON object: the engine and its options, sizes, times and counts, and `explain` with
/// --explain.
[[nodiscard]] nlohmann::ordered_json as_json(const WrittenImage& written);

/// {"views": [...]}, each with its name, its output and the keys of as_json.
[[nodiscard]] nlohmann::ordered_json scene_as_json(const std::vector<WrittenImage>& written);

/// Of a film or numbered images: "output", "frames" and the keys of as_json, of the first frame,
/// with the median time of all as "frame_ms".
[[nodiscard]] nlohmann::ordered_json film_as_json(const std::vector<WrittenImage>& written);
[[nodiscard]] std::string film_as_text(const std::vector<WrittenImage>& written);

/// Returns the report as text.
[[nodiscard]] std::string as_text(const WrittenImage& written);

}  // namespace relief::cli
