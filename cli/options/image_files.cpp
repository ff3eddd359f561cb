#include "cli/options/image_files.h"

#include <string>
#include <string_view>
#include <system_error>

#include "cli/options/paths.h"
#include "common/image/film_file.h"
#include "loader/image_writer.h"

namespace relief::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kViewMark = "{view}";

fs::path image_file(const fs::path& pattern, const std::string& view) {
  std::string name = pattern.string();
  for (std::size_t at = name.find(kViewMark); at != std::string::npos;
       at = name.find(kViewMark, at + view.size())) {
    name.replace(at, kViewMark.size(), view);
  }
  return name;
}

}  // namespace

bool marks_views(const fs::path& pattern) {
  return pattern.string().find(kViewMark) != std::string::npos;
}

bool names_each_view(const fs::path& pattern, const ScenePlan& plan) {
  return plan.views.size() == 1 || marks_views(pattern);
}

std::vector<fs::path> image_files(const fs::path& pattern, const ScenePlan& plan) {
  std::vector<fs::path> files;
  for (std::size_t frame = 0; frame < plan.film_frames; ++frame)
    files.push_back(is_film_name(pattern) ? pattern : frame_file(pattern, frame));
  if (plan.film_frames > 0) return files;
  files.reserve(plan.views.size());
  for (const PlannedView& view : plan.views) files.push_back(image_file(pattern, view.name));
  return files;
}

Status check_files(const ScenePlan& plan, const fs::path& texture,
                   const std::vector<fs::path>& images) {
  RELIEF_TRY_ASSIGN(auto inputs, find_inputs(plan));
  if (!texture.empty() && texture != "none") {
    std::error_code ignored;
    if (!fs::exists(texture, ignored))
      return make_error("{}: there is no such file", texture.string());
    inputs.push_back(texture);
  }
  for (const fs::path& image : images) RELIEF_TRY(check_output(image, inputs));
  return {};
}

}  // namespace relief::cli
