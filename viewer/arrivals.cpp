#include "viewer/arrivals.h"

#include <string>
#include <utility>

#include "common/transform.h"
#include "viewer/distance_colours.h"
#include "viewer/remember.h"

namespace relief {

TakenArrivals Arrivals::take(glm::ivec2 window, double now, Display& display, Session& session) {
  TakenArrivals taken;
  const auto report = [&](const Status& status) {
    if (status) return;
    add_message(session, status.error().message, true, now);
    taken.has_told = true;
  };
  Arrival arrival = session.document.take();
  for (std::string& note : arrival.notes) {
    add_message(session, std::move(note), false, now);
    taken.has_told = true;
  }
  if (arrival.failure) {
    report(Error{*arrival.failure});
    give_up_distance(session, arrival.is_other);
  }
  if (arrival.is_other) {
    session.points_read = 0;
    if (!arrival.failure) {
      session.look = session.document.plan().views.front().settings;
      // What a scene file asks for is the first look of its models.
      if (!session.document.plan().file.empty()) session.first_look = session.look;
      report(remember_files(session, window));
    }
    session.inspected.scene_before.reset();
  }
  if (arrival.points) {
    session.points_read = arrival.points->total;
    if (arrival.is_other) start_camera(session, arrival.points->extent);
    report(display.show(*arrival.points));
  }
  const bool shows_waiting = is_waiting() && arrival.scene == nullptr;
  std::shared_ptr<const LoadedScene> scene =
      shows_waiting ? std::move(waiting_) : std::move(arrival.scene);
  waiting_.reset();
  taken.changes = scene != nullptr || arrival.points;
  if (scene == nullptr) return taken;
  if (display.is_empty() && !scene->patches.patches.empty()) {
    const ScanPoints samples = scan_points_of(scene->patches);
    start_camera(session, samples.extent);
    report(display.show(samples));
    waiting_ = std::move(scene);
    return taken;
  }
  if (arrival.is_other && !arrival.points)
    start_camera(session, scene->patches);
  else
    session.navigator.set_model(without_patches(scene->patches), true);
  report(display.show(std::move(scene), session));
  return taken;
}

}  // namespace relief
