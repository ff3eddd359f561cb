#include "common/scene/views/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace relief {
namespace {

/// No velocity at a key is more than so many times the slower of the steps beside it. Up to 3 a
/// cubic stays between its ends (Fritsch and Carlson 1980).
constexpr double kFastest = 3.0;

// A turn as a vector: its axis times half its angle.

glm::dvec3 log_of(glm::dquat turn) {
  if (turn.w < 0.0) turn = -turn;  // the shorter way
  const glm::dvec3 v(turn.x, turn.y, turn.z);
  const double sine = glm::length(v);
  return sine > 0.0 ? std::atan2(sine, turn.w) / sine * v : v;
}

glm::dquat exp_of(glm::dvec3 turn) {
  const double angle = glm::length(turn);
  if (!(angle > 0.0)) return {1.0, 0.0, 0.0, 0.0};
  const glm::dvec3 v = std::sin(angle) / angle * turn;
  return {std::cos(angle), v.x, v.y, v.z};
}

glm::dquat orientation_of(const Camera& camera) {
  return glm::normalize(glm::quat_cast(glm::transpose(view_rotation(camera))));
}

/// What of a camera is a number: the logarithms of its distance to the target and of half the
/// image's height, at distance 1 for a perspective camera.
glm::dvec2 numbers_of(const Camera& camera) {
  const double half_height = camera.is_orthographic()
                                 ? 0.5 * camera.orthographic_height
                                 : std::tan(0.5 * glm::radians(camera.vertical_fov_degrees));
  return {std::log(glm::distance(camera.eye, camera.target)), std::log(half_height)};
}

/// What changes from one key to the next.
struct Step {
  double seconds = 1.0;
  glm::dvec3 way{0.0};      ///< of the target
  glm::dvec3 turn{0.0};     ///< from the first orientation, in its own frame
  glm::dvec2 numbers{0.0};  ///< see numbers_of
};

Step step_between(const Camera& from, const Camera& to, double seconds) {
  return {seconds, to.target - from.target,
          log_of(glm::conjugate(orientation_of(from)) * orientation_of(to)),
          numbers_of(to) - numbers_of(from)};
}

/// The velocity at a key between two steps: of the parabola through the three keys, but no faster
/// than kFastest times the slower step. So a camera that waits does not move.
glm::dvec3 velocity(glm::dvec3 before, glm::dvec3 after, double seconds_before,
                    double seconds_after) {
  const glm::dvec3 mean =
      (seconds_after * before + seconds_before * after) / (seconds_before + seconds_after);
  const double fastest = kFastest * std::min(glm::length(before), glm::length(after));
  const double speed = glm::length(mean);
  return speed > fastest ? fastest / speed * mean : mean;
}

/// The velocity of a number, likewise; 0 where it turns round, so that it never leaves the range of
/// the keys.
double velocity(double before, double after, double seconds_before, double seconds_after) {
  if (before * after <= 0.0) return 0.0;
  const double mean =
      (seconds_after * before + seconds_before * after) / (seconds_before + seconds_after);
  const double fastest = kFastest * std::min(std::abs(before), std::abs(after));
  return std::clamp(mean, -fastest, fastest);
}

/// Changes a second.
struct Velocity {
  glm::dvec3 target{0.0};
  glm::dvec3 turn{0.0};
  glm::dvec2 numbers{0.0};
};

Velocity velocity_between(const Step& before, const Step& after) {
  const double s = before.seconds;
  const double t = after.seconds;
  Velocity at;
  at.target = velocity(before.way / s, after.way / t, s, t);
  at.turn = velocity(before.turn / s, after.turn / t, s, t);
  for (const glm::length_t c : {0, 1})
    at.numbers[c] = velocity(before.numbers[c] / s, after.numbers[c] / t, s, t);
  return at;
}

/// The value at part `u` of a step, less that at its begin, of the cubic curve that changes by
/// `way` in the step and has the given velocities at its ends.
template <class Value>
Value cubic(double u, Value way, Value velocity_before, Value velocity_after, double seconds) {
  return u * u * (3.0 - 2.0 * u) * way +
         u * (1.0 - u) * seconds * ((1.0 - u) * velocity_before - u * velocity_after);
}

/// The rotation from the begin of a step to part `u` of it, along the cubic curve that rotates by
/// `turn` in the step and has the given angular velocities at its ends (Kim, Kim and Shin 1995, "A
/// general construction scheme for unit quaternion curves", with the cumulative Bernstein basis).
glm::dquat cubic_turn(double u, glm::dvec3 turn, glm::dvec3 velocity_before,
                      glm::dvec3 velocity_after, double seconds) {
  const glm::dvec3 first = seconds / 3.0 * velocity_before;
  const glm::dvec3 last = seconds / 3.0 * velocity_after;
  const glm::dvec3 middle = log_of(exp_of(-first) * exp_of(turn) * exp_of(-last));
  const double rest = 1.0 - u;
  return exp_of((1.0 - rest * rest * rest) * first) * exp_of(u * u * (3.0 - 2.0 * u) * middle) *
         exp_of(u * u * u * last);
}

/// A path whose steps are counted round the end, if it is a loop.
class Motion {
 public:
  explicit Motion(const CameraPath& path) : path_(path), keys_(path.keys.size()) {
    assert(keys_ >= 2 && "as its type says");
  }

  /// The camera at part `u`, above 0 and below 1, of the step from a key.
  [[nodiscard]] Camera between(std::size_t key, double u) const {
    const Camera& from = path_.keys[key].camera;
    const Step step = step_from(key);
    const Velocity before = velocity_at(key);
    const Velocity after = velocity_at((key + 1) % keys_);
    const double s = step.seconds;

    const glm::dvec3 target = from.target + cubic(u, step.way, before.target, after.target, s);
    const glm::dquat orientation =
        glm::normalize(orientation_of(from) * cubic_turn(u, step.turn, before.turn, after.turn, s));
    const glm::dvec2 numbers =
        numbers_of(from) + cubic(u, step.numbers, before.numbers, after.numbers, s);
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    Camera camera;
    camera.target = target;
    camera.eye = target + std::exp(numbers.x) * axes[2];
    camera.up = axes[1];
    camera.vertical_fov_degrees = from.vertical_fov_degrees;
    const double half_height = std::exp(numbers.y);
    if (from.is_orthographic())
      camera.orthographic_height = 2.0 * half_height;
    else
      camera.vertical_fov_degrees = 2.0 * glm::degrees(std::atan(half_height));
    return camera;
  }

 private:
  [[nodiscard]] Step step_from(std::size_t key) const {
    const CameraKey& from = path_.keys[key];
    const CameraKey& to = path_.keys[(key + 1) % keys_];
    const double seconds = key + 1 < keys_
                               ? to.time - from.time
                               : duration_of(path_) - (from.time - path_.keys.front().time);
    return step_between(from.camera, to.camera, seconds);
  }

  [[nodiscard]] Velocity velocity_at(std::size_t key) const {
    if (!path_.is_loop && (key == 0 || key + 1 == keys_)) return {};
    return velocity_between(step_from((key + keys_ - 1) % keys_), step_from(key));
  }

  const CameraPath& path_;
  std::size_t keys_;
};

}  // namespace

double duration_of(const CameraPath& path) {
  const double steps = path.keys.back().time - path.keys.front().time;
  return path.is_loop ? steps + steps / static_cast<double>(path.keys.size() - 1) : steps;
}

Camera camera_at(const CameraPath& path, double seconds) {
  const double first = path.keys.front().time;
  const double duration = duration_of(path);
  if (path.is_loop && (seconds < first || seconds >= first + duration)) {
    seconds -= first;
    seconds = first + seconds - duration * std::floor(seconds / duration);
  }
  const auto after = std::ranges::upper_bound(path.keys, seconds, {}, &CameraKey::time);
  if (after == path.keys.begin()) return path.keys.front().camera;
  const CameraKey& key = *(after - 1);
  const auto number = static_cast<std::size_t>(&key - path.keys.data());
  const bool is_last = after == path.keys.end();
  if (seconds == key.time || (is_last && !path.is_loop)) return key.camera;
  const double next = is_last ? first + duration : after->time;
  const double u = (seconds - key.time) / (next - key.time);
  if (u <= 0.0) return key.camera;
  if (u >= 1.0) return path.keys[is_last ? 0 : number + 1].camera;
  return Motion(path).between(number, u);
}

Result<std::vector<Camera>> film_cameras(const CameraPath& path, double frames_per_second) {
  const double wanted = std::round(duration_of(path) * frames_per_second);
  if (wanted > static_cast<double>(kMaxFilmFrames)) {
    return make_error(
        "takes {:g} s, which at {:g} frames a second are {:.0f} frames; at most {} "
        "are drawn",
        duration_of(path), frames_per_second, wanted, kMaxFilmFrames);
  }
  const auto count = std::max(static_cast<std::size_t>(wanted), std::size_t{2});
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_end = i + 1 == count && !path.is_loop;
    cameras.push_back(is_end ? path.keys.back().camera
                             : camera_at(path, path.keys.front().time +
                                                   static_cast<double>(i) / frames_per_second));
  }
  return cameras;
}

}  // namespace relief
