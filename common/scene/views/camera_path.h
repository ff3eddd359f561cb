// A camera that moves through given ones: the path of a film. The file format: docs/render.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/scene/camera.h"
#include "common/scene/choices.h"

namespace relief {

/// The least distance of an eye from its target, world units.
inline constexpr double kShortestSight = 1e-12;

/// A camera that a path goes through.
struct CameraKey {
  std::string name;   ///< the user's; may be empty
  double time = 0.0;  ///< seconds
  Camera camera;      ///< its eye and target, and its up direction, at least kShortestSight long
};

/// At least two keys, in ascending order of time, all perspective or all orthographic.
struct CameraPath {
  std::vector<CameraKey> keys;
  std::optional<double> frames_per_second;  ///< that the film is meant to have, of kFrameRates
  bool is_loop = false;  ///< goes back to the first key, which takes as long as the mean step
};

inline constexpr NumberChoice kFrameRates{1.0, 240.0};  ///< frames a second
inline constexpr double kUsualFrameRate = 30.0;
/// The most frames of a film.
inline constexpr std::size_t kMaxFilmFrames = 100000;

/// Seconds from one key to the next where a file has no times.
inline constexpr double kUsualStep = 2.0;
/// Limits of a file, which may be hostile.
inline constexpr std::size_t kMaxCameraKeys = 10000;
inline constexpr double kMaxPathTime = 1e6;

/// Returns how long a path takes, seconds.
[[nodiscard]] double duration_of(const CameraPath& path);

/// Returns the camera at a time: at that of a key the key's own, exactly. Before the first key and
/// after the last one the camera stands there; a loop goes on.
///
/// In between, the target, the orientation, the distance to the target, and the field of view or
/// the image's height move along cubic curves through the keys, with continuous velocity: no faster
/// at a key than three times the slower of the two steps beside it, and the numbers among these
/// never beyond those of the keys beside. A path that is no loop begins and ends at rest. The
/// camera turns the shorter way between two orientations. Its up direction is at a right angle to
/// the line of sight. Differences are taken between keys, so that coordinates of any size cost no
/// precision.
[[nodiscard]] Camera camera_at(const CameraPath& path, double seconds);

/// Returns the cameras of a film's frames, which are the path's duration times the rate, and at
/// least 2. Frame i is at i / rate after the first key; the last one, unless the path is a loop, at
/// the last key. Fails, with a clause, if they are more than kMaxFilmFrames.
Result<std::vector<Camera>> film_cameras(const CameraPath& path, double frames_per_second);

/// Reads a camera path. Trusts nothing: fails, with one sentence that names the position in the
/// file, at what read_scene() refuses likewise, at times that do not ascend, an eye at its target,
/// and perspective cameras beside orthographic ones.
Result<CameraPath> read_camera_path(const std::filesystem::path& file);

/// Reads a camera path from the text of a file, as read_camera_path() does. `name` begins messages.
Result<CameraPath> parse_camera_path(std::string_view text, const std::string& name);

/// Returns the text of a path's file. Reading that gives the same path to the bit.
[[nodiscard]] std::string camera_path_text(const CameraPath& path);

/// Writes a path's file, atomically.
Status write_camera_path(const std::filesystem::path& file, const CameraPath& path);

}  // namespace relief
