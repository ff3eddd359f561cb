#include "viewer/arrivals.h"

#include <string>
#include <utility>

#include "common/transform.h"
#include "viewer/distance_colours.h"
#include "viewer/remember.h"

namespace relief {
namespace {

Status show(std::shared_ptr<const LoadedScene> scene, CollectedStore* collected, bool is_first,
            Display& display, Session& session) {
  if (is_first)
    start_camera(session, scene->patches);
  else
    session.navigator.set_model(without_patches(scene->patches), true);
  return display.show(std::move(scene), session, collected);
}

/// The samples of a scene as points, in place of the scene of other files.
Status show_samples(const LoadedScene& scene, Display& display, Session& session) {
  display.show_nothing(session);
  const ScanPoints samples = scan_points_of(scene.patches);
  start_camera(session, samples.extent);
  return display.show(samples);
}

}  // namespace

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
  if (arrival.is_other || arrival.scene != nullptr) forget();
  taken.changes = arrival.points.has_value() || arrival.scene != nullptr || is_collected();
  const bool is_first = arrival.is_other && !arrival.points;
  if (arrival.scene != nullptr) {
    if (!display.is_slow_to_show(*arrival.scene, session)) {
      report(show(std::move(arrival.scene), nullptr, is_first, display, session));
    } else {
      if (is_first) report(show_samples(*arrival.scene, display, session));
      waiting_ = std::move(arrival.scene);
    }
  } else if (waiting_ != nullptr) {
    const auto scene = std::exchange(waiting_, nullptr);
    job_ = display.collect(scene, session);
    if (job_ == nullptr) report(show(scene, nullptr, false, display, session));
  } else if (is_collected()) {
    const std::unique_ptr<CollectJob> job = std::move(job_);
    report(show(job->scene(), job->collected(), false, display, session));
  }
  session.is_preparing = job_ != nullptr || waiting_ != nullptr;
  return taken;
}

}  // namespace relief
