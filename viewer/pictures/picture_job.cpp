#include "viewer/pictures/picture_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "common/image/film_file.h"
#include "common/io/extension.h"
#include "common/patch_file/patch_file.h"
#include "common/scene/views/view_camera.h"
#include "loader/image_writer.h"
#include "loader/scene/view_settings.h"
#include "renderer/render.h"

namespace relief {
namespace {

/// The frames of a film count as units of one stage, whatever the renderer calls its own.
class FilmProgress final : public Progress {
 public:
  FilmProgress(Progress& outer, std::size_t frames) : outer_(outer) {
    outer_.begin_stage("render", frames);
  }
  void advance_frame() { outer_.advance(1); }
  void note(std::string_view text) override { outer_.note(text); }
  [[nodiscard]] bool cancelled() const override { return outer_.cancelled(); }

 private:
  Progress& outer_;
};

std::vector<std::filesystem::path> files_of(const PictureRequest& request) {
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 0; k < request.views.size(); ++k) {
    const bool is_numbered = request.is_film && !is_film_name(request.file);
    files.push_back(is_numbered ? frame_file(request.file, k) : request.file);
  }
  return files;
}

/// The plan, seen by the cameras of the request: of a patch file they decide which tiles are read.
ScenePlan plan_of(const PictureRequest& request) {
  ScenePlan plan = request.plan;
  const RenderSettings& first = request.views.front();
  SceneSettings& seen = plan.views.front().settings;
  seen = with_camera(seen, first.camera);
  seen.roll_degrees.reset();
  seen.zoom.reset();
  seen.size = ImageSize{first.width, first.height};
  plan.film_frames = 0;
  plan.film_cameras.clear();
  if (!request.is_film) return plan;
  plan.film_frames = request.views.size();
  for (const RenderSettings& frame : request.views) plan.film_cameras.push_back(frame.camera);
  return plan;
}

Result<std::shared_ptr<const LoadedScene>> load(const PictureRequest& request, Progress& progress) {
  LoadOptions options = request.load;
  options.on_points = {};
  RELIEF_TRY_ASSIGN(auto scene, load_scene(plan_of(request), options, progress));
  return std::make_shared<const LoadedScene>(std::move(scene));
}

}  // namespace

Status check_picture_name(const std::filesystem::path& file, bool is_film) {
  const std::string extension = lower_extension(file);
  if (extension == ".png" || extension == ".exr") return {};
  if (is_film && is_film_name(file)) return {};
  return is_film ? make_error("{}: a film is a .mp4 or .webm, or numbered .png or .exr files",
                              file.string())
                 : make_error("{}: a picture is a .png or .exr", file.string());
}

bool serves(const LoadedScene& scene, const PictureRequest& request) {
  const auto engine = engine_of(request.plan.views.front());
  return engine && (*engine)->forms.front() == ModelForm::Patches &&
         !scene.patches.patches.empty() &&
         std::none_of(request.plan.models.begin(), request.plan.models.end(),
                      [](const SceneModel& model) { return names_patch_file(model.file); });
}

std::filesystem::path free_path(const std::filesystem::path& path) {
  std::error_code unknown;
  std::filesystem::path free = path;
  for (int number = 2; std::filesystem::exists(free, unknown); ++number) {
    free = path;
    free.replace_filename(
        fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string()));
  }
  return free;
}

Status make_picture(const PictureRequest& request, Progress& progress) {
  std::shared_ptr<const LoadedScene> scene = request.scene;
  if (scene == nullptr || !serves(*scene, request)) {
    RELIEF_TRY_ASSIGN(scene, load(request, progress));
  }
  if (progress.cancelled()) return interrupted_error();
  const auto files = files_of(request);
  ImageWriter writer(files, request.frames_per_second);
  const auto legend = request.has_legend ? scene->colours : std::nullopt;
  std::optional<FilmProgress> frames;
  if (request.is_film) frames.emplace(progress, request.views.size());
  const auto keep = [&](std::size_t view, RenderResult result) -> Status {
    RELIEF_TRY(writer.write(view, result.image, request.exposure, legend));
    if (frames) frames->advance_frame();
    return {};
  };
  Progress& of_views = frames ? static_cast<Progress&>(*frames) : progress;
  RELIEF_TRY(render_views(scene->forms(), request.views, keep, of_views));
  return writer.finish();
}

PictureJob::PictureJob(PictureRequest request)
    : request_(std::move(request)), thread_([this] {
        Status made = [this]() -> Status {
          try {
            return make_picture(request_, progress_);
          } catch (const std::bad_alloc&) {
            return make_error("{}: there is not enough memory for this picture",
                              request_.file.string());
          }
        }();
        const std::lock_guard lock(mutex_);
        result_ = std::move(made);
      }) {}

PictureJob::~PictureJob() {
  progress_.cancel();
}

std::optional<Status> PictureJob::take_result() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

}  // namespace relief
