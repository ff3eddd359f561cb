#include "viewer/picture_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "common/io/extension.h"
#include "loader/command/render_command.h"

namespace relief {
namespace {

/// The renderer's settings of a picture of the view.
Result<RenderSettings> picture_settings(const std::filesystem::path& file, Session& session) {
  const SceneSettings& look = edited_look(session);
  RELIEF_TRY_ASSIGN(RenderSettings settings, settings_of(session, look));
  if (const auto size = session.picture.size) {
    settings.width = size->width;
    settings.height = size->height;
  }
  if (session.picture.is_transparent) settings.background.reset();
  if (lower_extension(file) == ".exr")
    settings.outputs = look.outputs.value_or(Outputs{true, true, true, true});
  return settings;
}

/// A request that lacks its views.
PictureRequest request_for(const std::filesystem::path& file, Session& session) {
  PictureRequest request;
  request.file = file;
  request.plan = session.document.plan();
  request.plan.views.front().settings = edited_look(session);
  request.load = session.document.options();
  // The camera's up direction is not that of heights.
  if (request.load.colour_by && !request.load.colour_by->up)
    request.load.colour_by->up = session.document.plan().views.front().settings.up.value_or(
        session.scene->patches.stance.up);
  request.exposure = edited_look(session).exposure.value_or(0.0);
  request.scene = session.scene;
  return request;
}

Status check_order(const std::filesystem::path& file, bool is_film, const Session& session) {
  if (session.scene == nullptr) return make_error("There is no surface to make a picture of yet");
  if (session.picture_job != nullptr)
    return make_error("A picture is being made; wait for it, or cancel it");
  RELIEF_TRY(check_picture_name(file, is_film));
  RELIEF_TRY_ASSIGN(const auto inputs, find_inputs(session.document.plan()));
  std::error_code is_missing;
  for (const std::filesystem::path& input : inputs) {
    if (std::filesystem::equivalent(file, input, is_missing))
      return make_error("{}: is an open file; choose another name", file.string());
  }
  return {};
}

Status begin_picture(const std::filesystem::path& file, Session& session) {
  RELIEF_TRY(check_order(file, false, session));
  PictureRequest request = request_for(file, session);
  RELIEF_TRY_ASSIGN(RenderSettings view, picture_settings(file, session));
  request.views.push_back(std::move(view));
  session.picture_job = std::make_unique<PictureJob>(std::move(request));
  return {};
}

Status begin_film(const std::filesystem::path& file, Session& session) {
  RELIEF_TRY(check_order(file, true, session));
  PictureRequest request = request_for(file, session);
  request.is_film = true;
  request.frames_per_second = session.path.frames_per_second;
  RELIEF_TRY_ASSIGN(const CameraPath path, path_through(session.bookmarks, session.path));
  RELIEF_TRY_ASSIGN(const auto cameras, film_cameras(path, session.path.frames_per_second));
  RELIEF_TRY_ASSIGN(const RenderSettings view, picture_settings(file, session));
  request.views.assign(cameras.size(), view);
  for (std::size_t k = 0; k < cameras.size(); ++k) request.views[k].camera = cameras[k];
  session.picture_job = std::make_unique<PictureJob>(std::move(request));
  return {};
}

void report(const Status& status, double now, Session& session) {
  if (!status) add_message(session, status.error().message, true, now);
}

}  // namespace

void order_picture(const std::filesystem::path& file, double now, Session& session) {
  report(begin_picture(file, session), now, session);
}

void order_film(const std::filesystem::path& file, double now, Session& session) {
  report(begin_film(file, session), now, session);
}

void write_path(const std::filesystem::path& file, double now, Session& session) {
  const auto path = path_through(session.bookmarks, session.path);
  const Status written = path ? write_camera_path(file, *path) : Status(path.error());
  report(written, now, session);
  if (written) add_message(session, fmt::format("{}: written", file.string()), false, now);
}

Result<std::string> picture_command(const std::filesystem::path& file, double now,
                                    Session& session) {
  if (session.scene == nullptr) return make_error("There is no surface to make a picture of yet");
  RELIEF_TRY(check_picture_name(file, false));
  RELIEF_TRY_ASSIGN(const RenderSettings settings, picture_settings(file, session));
  CommandedImage image;
  image.output = file;
  image.load = session.document.options();
  image.exposure = edited_look(session).exposure;
  image.outputs = edited_look(session).outputs;
  RELIEF_TRY_ASSIGN(RenderCommand command,
                    render_command(session.document.plan(), *session.scene, settings, image));
  for (const std::string& clause : command.missing)
    add_message(session, fmt::format("The command makes another picture: {}", clause), true, now);
  return std::move(command.line);
}

bool take_picture(double now, Session& session) {
  if (session.picture_job == nullptr) return false;
  const auto result = session.picture_job->take_result();
  if (!result) return false;
  const auto job = std::exchange(session.picture_job, nullptr);
  const std::string file = job->request().file.string();
  if (*result)
    add_message(session, fmt::format("{}: written", file), false, now);
  else if (job->is_cancelled())
    add_message(session, fmt::format("{}: cancelled", file), false, now);
  else
    report(*result, now, session);
  return true;
}

void toggle_preview(double now, Session& session) {
  if (session.preview) return session.preview.reset();
  auto path = path_through(session.bookmarks, session.path);
  if (!path) return report(path.error(), now, session);
  session.navigator.set_camera(path->keys.front().camera);  // ends a transition
  session.preview = PathPreview{*std::move(path)};
}

bool play(double seconds, Session& session) {
  if (!session.preview) return false;
  PathPreview& preview = *session.preview;
  session.navigator.set_camera(camera_at(preview.path, preview.seconds));
  const double whole = duration_of(preview.path);
  if (preview.seconds >= whole && !preview.path.is_loop) {
    session.preview.reset();
    return true;
  }
  preview.seconds += seconds;
  if (!preview.path.is_loop) preview.seconds = std::min(preview.seconds, whole);
  return true;
}

}  // namespace relief
