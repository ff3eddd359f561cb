#include "viewer/navigation/navigator.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "common/bounds.h"
#include "common/scene/views/framing.h"
#include "common/scene/views/view_camera.h"
#include "viewer/navigation/anchor.h"
#include "viewer/navigation/move.h"

namespace relief {
namespace {

/// Without a surface ahead one flies as if there were one this far, in radii of the model.
constexpr double kLeastFlightRadii = 0.02;

/// A point alone is framed with as much around it as so many of the least images.
constexpr double kLeastFramedHeights = 20.0;

/// A line of sight closer to the up axis than this (sine) has no horizon.
constexpr double kNoHorizon = 1e-6;

}  // namespace

Navigator::Navigator() {
  set_model({}, false);
}

void Navigator::set_model(PatchModel extent, bool keep_camera) {
  assert(extent.patches.empty() && "an extent");
  extent_ = std::move(extent);
  if (keep_camera) {
    limits_ = limits_for(extent_, origin_, aspect());
    return;
  }
  up_axis_.reset();
  origin_ = limits_for(extent_, glm::dvec3(0.0), aspect()).centre;
  limits_ = limits_for(extent_, origin_, aspect());
  drag_.reset();
  set_camera(camera_on(std::nullopt));
  pivot_ = centre();
  is_home_ = true;
}

void Navigator::set_image(ImageSize size) {
  image_ = {std::max(size.width, 1U), std::max(size.height, 1U)};
  limits_ = limits_for(extent_, origin_, aspect());
  if (is_home_) {
    const Camera home = camera_on(std::nullopt);
    if (transition_) {
      transition_->to = pose_of(home, origin_);
      transition_->end = home;
    } else {
      camera_ = home;
      pose_ = pose_of(home, origin_);
    }
  }
  restart_drag();
}

void Navigator::begin(DragKind kind, glm::dvec2 cursor, std::optional<glm::dvec3> under) {
  stop();
  const bool turns = kind == DragKind::Orbit || kind == DragKind::Look;
  const glm::dvec3 point = turns ? orbit_anchor(under) : anchor(cursor, under);
  pose_.focus = depth_of(pose_, point);
  drag_ = Drag{kind, pose_, cursor, cursor, point, 0.0};
}

void Navigator::drag(glm::dvec2 cursor) {
  if (!drag_ || cursor == drag_->last) return;
  show(dragged(*drag_, cursor, drag_settings()));
}

void Navigator::end() {
  drag_.reset();
}

void Navigator::zoom(double steps, glm::dvec2 cursor, std::optional<glm::dvec3> under) {
  stop();
  put(zoomed(pose_, steps, anchor(cursor, under), limits_));
}

void Navigator::pan(glm::dvec2 shift, glm::dvec2 cursor, std::optional<glm::dvec3> under) {
  stop();
  Drag drag{DragKind::Pan, pose_, cursor, cursor, anchor(cursor, under), 0.0};
  put(dragged(drag, cursor + shift, drag_settings()));
}

void Navigator::fly(glm::dvec3 direction, double seconds, double speed_factor,
                    std::optional<glm::dvec3> ahead) {
  stop();
  Flight flight;
  flight.direction = speed_factor * glm::clamp(direction, glm::dvec3(-1.0), glm::dvec3(1.0));
  flight.seconds = seconds;
  flight.up = style_ == OrbitStyle::Turntable ? stance().up : pose_.up();
  if (const auto surface = usable_point(pose_, local(ahead))) {
    pivot_ = origin_ + *surface;
    flight.surface = depth_of(pose_, *surface);
    flight.distance = *flight.surface;
  } else {
    flight.distance =
        std::max(glm::distance(pose_.eye, pivot_ - origin_), kLeastFlightRadii * limits_.radius);
  }
  put(flown(pose_, flight, limits_));
}

void Navigator::home() {
  glide(camera_on(std::nullopt));
  pivot_ = centre();
  is_home_ = true;
}

void Navigator::look_from(const Orbit& orbit) {
  glide(camera_on(orbit));
  pivot_ = centre();
}

void Navigator::frame_all() {
  glide(framed(destination(), points_to_frame(extent_), aspect(), true));
  pivot_ = centre();
}

void Navigator::frame(std::span<const glm::dvec3> points) {
  assert(!points.empty() && "something to frame");
  std::vector<glm::dvec3> all(points.begin(), points.end());
  const Bounds bounds = bounds_of(all);
  const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max);
  const glm::dmat3 axes = glm::transpose(view_rotation(destination()));
  const double least = 0.5 * kLeastFramedHeights * limits_.least_height;
  for (const double side : {-least, least}) {
    all.push_back(middle + side * axes[0]);
    all.push_back(middle + side * axes[1]);
  }
  glide(framed(destination(), all, aspect(), true));
  pivot_ = middle;
}

void Navigator::roll(double degrees) {
  glide(rolled(destination(), degrees));
}

void Navigator::level() {
  Camera camera = destination();
  const glm::dvec3 axis = stance().up;
  const glm::dvec3 sight = glm::normalize(camera.target - camera.eye);
  if (glm::length(glm::cross(sight, axis)) < kNoHorizon) return;
  camera.up = axis;
  glide(camera);
}

void Navigator::go_to(const Camera& camera) {
  glide(camera);
  pivot_ = camera.target;
}

void Navigator::set_camera(const Camera& camera) {
  stop();
  put(pose_of(camera, origin_));
  camera_ = with_usable_up(camera);
  pivot_ = camera.target;
}

void Navigator::set_up_axis(std::optional<glm::dvec3> up) {
  up_axis_ = up;
  home();
}

void Navigator::set_orthographic(bool orthographic) {
  const Pose pose = pose_of(destination(), origin_);
  change_lens(with_projection(pose, orthographic, depth_at_pivot(pose), limits_));
}

void Navigator::set_field_of_view(double degrees) {
  const Pose pose = pose_of(destination(), origin_);
  const double limited = std::clamp(degrees, kMinFieldOfView, kMaxFieldOfView);
  change_lens(with_field_of_view(pose, limited, depth_at_pivot(pose), limits_));
}

bool Navigator::advance(double seconds) {
  if (!transition_) return false;
  transition_->elapsed += std::max(seconds, 0.0);
  if (transition_->elapsed < kTransitionSeconds) {
    show(pose_of(*transition_, limits_));
    return true;
  }
  camera_ = transition_->end;
  pose_ = pose_of(camera_, origin_);
  transition_.reset();
  return false;
}

Stance Navigator::stance() const {
  return stance_of(up_axis_, extent_.stance);
}

glm::dvec2 Navigator::size() const {
  return {image_.width, image_.height};
}

double Navigator::aspect() const {
  return static_cast<double>(image_.width) / image_.height;
}

DragSettings Navigator::drag_settings() const {
  return {size(), style_, stance().up, limits_};
}

Camera Navigator::camera_on(const std::optional<Orbit>& orbit) const {
  SceneSettings settings;
  settings.size = image_;
  settings.up = up_axis_;
  settings.orbit = orbit;
  settings.fov_degrees = destination().vertical_fov_degrees;
  if (destination().is_orthographic()) settings.orthographic = OrthographicSize{};
  const auto camera = camera_for(settings, extent_);
  return camera && is_usable(*camera) ? *camera : Camera{};  // bounds that a hostile file has
}

const Camera& Navigator::destination() const {
  return transition_ ? transition_->end : camera_;
}

double Navigator::depth_at_pivot(const Pose& pose) const {
  return background_depth(pose, pivot_ - origin_, limits_);
}

std::optional<glm::dvec3> Navigator::local(const std::optional<glm::dvec3>& point) const {
  return point ? std::optional(*point - origin_) : std::nullopt;
}

glm::dvec3 Navigator::anchor(glm::dvec2 cursor, const std::optional<glm::dvec3>& under) {
  const auto point = usable_point(pose_, local(under));
  if (!point) return background_point(pose_, cursor, size(), pivot_ - origin_, limits_);
  pivot_ = origin_ + *point;
  return *point;
}

glm::dvec3 Navigator::orbit_anchor(const std::optional<glm::dvec3>& under) {
  const auto point = usable_point(pose_, local(under));
  const glm::dvec3 about =
      point ? *point : background_pivot(pose_, size(), pivot_ - origin_, limits_);
  pivot_ = origin_ + about;
  return about;
}

void Navigator::stop() {
  if (transition_) is_home_ = false;
  transition_.reset();
}

void Navigator::show(const Pose& pose) {
  pose_ = pose;
  camera_ = camera_of(pose, origin_);
  if (!transition_) is_home_ = false;
}

void Navigator::put(const Pose& pose) {
  show(pose);
  restart_drag();
}

void Navigator::restart_drag() {
  if (drag_) begin(drag_->kind, drag_->last, origin_ + drag_->point);
}

void Navigator::glide(const Camera& camera) {
  if (!is_usable(camera)) return;
  drag_.reset();
  is_home_ = false;
  transition_ = Transition{pose_, pose_of(camera, origin_), with_usable_up(camera), 0.0};
}

void Navigator::change_lens(const Pose& pose) {
  if (transition_) {
    glide(camera_of(pose, origin_));
  } else {
    put(pose);
  }
}

}  // namespace relief
