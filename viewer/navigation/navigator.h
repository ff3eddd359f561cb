// How the camera of a window moves: what its owner calls for each input event.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "common/patch.h"
#include "common/scene/camera.h"
#include "common/scene/choices.h"
#include "common/stance.h"
#include "viewer/navigation/drag.h"
#include "viewer/navigation/pose.h"
#include "viewer/navigation/transition.h"

namespace relief {

/// The camera of a window, and what moves it. Pure mathematics: no window, no OpenGL, no clock.
///
/// Cursors are in pixels of the framebuffer from its upper left corner, y downward, fractions and
/// positions outside allowed: on a display with high density, multiply what the window system
/// reports by the content scale. Points and cameras are in world units.
///
/// `under` is the point of the surface below the cursor, which the caller has picked; none over the
/// background. A point that is not finite or not before the eye counts as none. Over the background
/// stands in for it the point of the cursor's ray that is as deep as pivot(); for an orbit, pivot()
/// itself.
///
/// What holds after every call: the camera is finite, its eye is not its target, and its up
/// direction is at a right angle to the line of sight (unless a caller's camera is shown, whose up
/// direction is the caller's). No input makes the image jump: a drag of no length changes nothing.
/// Drags, wheel and flights end a transition where it is; new views start from there.
class Navigator {
 public:
  Navigator();

  // What there is to see.

  /// Takes the model's bounds, bounding sphere, extreme points, stance and spacing
  /// (without_patches() in common/transform.h makes an extent). Unless the camera is kept, shows
  /// home() at once and forgets the up axis that was asked for. Until the first call there is a
  /// model of size 1 at the origin.
  void set_model(PatchModel extent, bool keep_camera);

  /// Sets the framebuffer's size; sides of 0 (a window that is minimised) count as 1. Keeps the
  /// camera, except that a home() that nobody has moved since is framed anew.
  void set_image(ImageSize size);

  // Drags: begin, any number of drag, end.

  void begin(DragKind kind, glm::dvec2 cursor, std::optional<glm::dvec3> under);
  void drag(glm::dvec2 cursor);
  void end();
  [[nodiscard]] bool is_dragging() const { return drag_.has_value(); }

  // Wheel, pinch, keys.

  /// Goes nearer to the point under the cursor, which stays at its pixel; each step divides its
  /// distance (orthographic: the image's height) by kZoomStep. Steps may be fractions, and
  /// negative. A pinch that enlarges by `scale` is zoom_steps(scale) steps. Stops at
  /// least_image_height() and at kFarthestRadii.
  void zoom(double steps, glm::dvec2 cursor, std::optional<glm::dvec3> under);

  /// Shifts the image by some pixels, as a drag of two fingers does: a pan from `cursor` to `cursor
  /// + shift`.
  void pan(glm::dvec2 shift, glm::dvec2 cursor, std::optional<glm::dvec3> under);

  /// Flies for some seconds. `direction`: right, up and forward, each -1 to 1; up is the model's up
  /// axis (trackball: the image's). The speed is `speed_factor` times the distance ahead a second:
  /// that to `ahead`, the surface in the image's middle, or without one to pivot(). Never reaches
  /// `ahead`. An orthographic camera goes forward by enlarging.
  void fly(glm::dvec3 direction, double seconds, double speed_factor,
           std::optional<glm::dvec3> ahead = std::nullopt);

  // Views. All of them but the setters go there smoothly.

  /// Goes to the camera that `relief render` has without options, but for the up axis, the field of
  /// view and the projection, which stay.
  void home();

  /// Goes to the camera of `relief render --view`: an entry of kViews (common/scene/scene.h), or
  /// any orbit. Framed, unless the orbit has a distance.
  void look_from(const Orbit& orbit);

  /// Frames the model, or some points (not empty), from the present direction.
  void frame_all();
  void frame(std::span<const glm::dvec3> points);

  /// Turns the camera about its line of sight, counter-clockwise as seen from the eye.
  void roll(double degrees);

  /// Turns the camera about its line of sight until the horizon is level. Nothing to do for one
  /// that looks straight up or down.
  void level();

  /// Goes to a camera, for example a bookmark's: is_usable() (pose.h), else nothing happens. Its
  /// target becomes the pivot.
  void go_to(const Camera& camera);

  /// Shows a usable camera at once, to the last bit. Its target becomes the pivot.
  void set_camera(const Camera& camera);

  // Settings.

  /// Stands the model on another axis, of any length but 0, or on its own one, and shows home().
  void set_up_axis(std::optional<glm::dvec3> up);

  /// Returns the axis that was asked for; none: the model's own.
  [[nodiscard]] std::optional<glm::dvec3> up_axis() const { return up_axis_; }

  /// Turntable by default.
  void set_orbit_style(OrbitStyle style) { style_ = style; }

  /// Switches the projection. What is as deep as pivot() stays where it is in the image, and as
  /// large.
  void set_orthographic(bool orthographic);

  /// Sets the vertical field of view, kMinFieldOfView to kMaxFieldOfView degrees; the same holds.
  void set_field_of_view(double degrees);

  /// Sets the point that the background turns about and whose depth projections keep.
  void set_pivot(glm::dvec3 point) { pivot_ = point; }

  // Time.

  /// Lets a transition go on for some seconds. Returns whether it still goes on.
  bool advance(double seconds);
  [[nodiscard]] bool moving() const { return transition_.has_value(); }

  // What is shown.

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] glm::dvec3 pivot() const { return pivot_; }
  [[nodiscard]] Stance stance() const;  ///< of the model, or of the up axis that was asked for
  [[nodiscard]] OrbitStyle orbit_style() const { return style_; }

  /// How little of the world the image's height shows at the pivot's depth when one has zoomed in
  /// all the way.
  [[nodiscard]] double least_image_height() const { return limits_.least_height; }

 private:
  [[nodiscard]] glm::dvec2 size() const;
  [[nodiscard]] double aspect() const;
  [[nodiscard]] glm::dvec3 centre() const { return origin_ + limits_.centre; }
  [[nodiscard]] DragSettings drag_settings() const;

  /// The camera of `relief render` for an orbit, or for the first look.
  [[nodiscard]] Camera camera_on(const std::optional<Orbit>& orbit) const;

  /// The camera that a transition ends with, else the present one.
  [[nodiscard]] const Camera& destination() const;
  [[nodiscard]] double depth_at_pivot(const Pose& pose) const;

  /// From the poses' origin.
  [[nodiscard]] std::optional<glm::dvec3> local(const std::optional<glm::dvec3>& point) const;

  // The point that a movement refers to; the pivot becomes it, unless it is the background.
  glm::dvec3 anchor(glm::dvec2 cursor, const std::optional<glm::dvec3>& under);
  glm::dvec3 orbit_anchor(const std::optional<glm::dvec3>& under);

  void stop();  ///< ends a transition
  void show(const Pose& pose);
  void put(const Pose& pose);  ///< likewise, and a drag goes on from there
  void restart_drag();
  void glide(const Camera& camera);
  void change_lens(const Pose& pose);

  PatchModel extent_;
  std::optional<glm::dvec3> up_axis_;  ///< that was asked for
  ImageSize image_;
  Limits limits_;
  OrbitStyle style_ = OrbitStyle::Turntable;

  glm::dvec3 origin_{0.0};  ///< of the poses
  Pose pose_;
  Camera camera_;  ///< pose_ in the world
  glm::dvec3 pivot_{0.0};
  bool is_home_ = false;  ///< nobody has moved the camera since home()
  std::optional<Drag> drag_;
  std::optional<Transition> transition_;
};

}  // namespace relief
