// What the user of a window has chosen, and what it shows: all that panels read and change.
#pragma once

#include <deque>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/scene/scene.h"
#include "renderer/settings.h"
#include "viewer/choices/divider.h"
#include "viewer/document/document.h"
#include "viewer/drawing/looks.h"
#include "viewer/drawing/uploaded_scene.h"
#include "viewer/inspecting/inspection.h"
#include "viewer/measuring/tool.h"
#include "viewer/navigation/bookmarks.h"
#include "viewer/navigation/navigator.h"
#include "viewer/pictures/bookmark_path.h"
#include "viewer/pictures/picture_job.h"
#include "viewer/settings/preferences.h"

namespace relief {

/// A sentence for the user, which fades after some seconds; errors stay longer.
struct Message {
  std::string text;
  bool is_error = false;
  double since = 0.0;  ///< the window's clock, seconds
};

/// What pictures and films are like, beside the look.
struct PictureChoice {
  std::optional<ImageSize> size;  ///< none: the window's
  bool is_transparent = false;    ///< no background
};

/// A camera path that is played in the window.
struct PathPreview {
  CameraPath path;
  double seconds = 0.0;  ///< since it began
};

/// What is known of what an inspection shows, and what it needs to be undone.
struct InspectionState {
  bool is_distance_loaded = false;           ///< or being loaded: the files coloured by distance
  std::optional<ColourBy> colour_by_before;  ///< LoadOptions::colour_by without that
  std::shared_ptr<const LoadedScene> scene_before;  ///< likewise; null: to be loaded again
  std::optional<double> fragments_a_pixel;          ///< mean over pixels that the model covers
  std::optional<double> psnr_db;                    ///< of the picture against the truth
  std::string truth;                                ///< what the truth shows
  std::optional<double> truth_share;                ///< done of it, 0 to 1, while it is traced
};

/// What a picture shows, but for where it is seen from.
struct ChosenLooks {
  SceneSettings left;
  std::optional<SceneSettings> right;  ///< of the divider
  Inspection inspection = Inspection::Picture;
};

struct Session {
  explicit Session(Document opened) : document(std::move(opened)) {}

  Document document;
  std::shared_ptr<const LoadedScene> scene;   ///< what is shown; null: points, or nothing yet
  std::optional<NumberChoice> volume_values;  ///< the range of its volumes' values
  std::size_t points_read = 0;                ///< of the scan whose points came last
  bool is_preparing = false;                  ///< what was read is made ready to be shown
  Navigator navigator;
  Bookmarks bookmarks;
  std::filesystem::path bookmarked;  ///< the file that they belong to; empty: none is open

  SceneSettings first_look;               ///< that of the command line
  SceneSettings look;                     ///< of the picture, but for its camera and size
  std::optional<SceneSettings> compared;  ///< the look right of the divider
  bool edits_compared = false;            ///< panels change that one
  Divider divider;

  MeasuringTool measuring;
  MeasurementKind last_tool = MeasurementKind::Distance;  ///< that the key M chooses
  std::optional<PickedPoint> hovered;                     ///< the surface under a resting cursor

  PictureChoice picture;
  PathChoice path;
  std::optional<PathPreview> preview;
  std::unique_ptr<PictureJob> picture_job;      ///< the picture or film that is being made
  bool wants_picture = false;                   ///< by its key
  Inspection inspection = Inspection::Picture;  ///< what is shown in place of the picture
  InspectionState inspected;

  double target_ms = 33.0;  ///< of a frame while something moves
  Preferences preferences;  ///< what is remembered but is not above

  bool shows_panels = true;
  bool shows_help = false;
  std::deque<Message> messages;  ///< the newest last

  /// Set by whoever changes a look; the picture is then drawn anew.
  bool look_changed = true;

  std::string asks_for_section;  ///< of the side panel, by title: it is to be opened and seen
  bool asks_for_file = false;    ///< the field for a path is to be typed into
  bool closes_files = false;     ///< all that are open, before the next frame
  bool wants_close = false;
  bool wants_full_screen = false;

  glm::ivec2 window{0};     ///< the picture's size in pixels: the window's without the side panel
  double scale = 1.0;       ///< the window's: how large texts are
  StreamOptions streaming;  ///< of files that are read as views need them
  std::optional<StreamState> stream;  ///< of what is shown, if it is such a file

  double frame_ms = 0.0;  ///< of the last moving frame
};

/// The look that panels change: the left one, or the right one if that is chosen and there.
[[nodiscard]] SceneSettings& edited_look(Session& session);

/// Shows another model: from where the look's settings ask for, or as `relief render` does. Takes
/// what concerns the camera out of the look.
void start_camera(Session& session, const PatchModel& extent);

/// Takes what concerns the camera out of a look: that is the navigator's.
void forget_camera(SceneSettings& look);

void add_message(Session& session, std::string text, bool is_error, double now);

/// Takes messages away that have been there long enough. Returns whether there were some.
bool drop_old_messages(Session& session, double now);

/// Returns the renderer's settings of a look for the window's size and the present camera, as
/// `relief render` completes them, of `session.scene` or another scene of the open files. Fails as
/// render_settings_of() does.
Result<RenderSettings> settings_of(const Session& session, const SceneSettings& look);
Result<RenderSettings> settings_of(const Session& session, const SceneSettings& look,
                                   const LoadedScene& scene);

/// What the user has chosen.
[[nodiscard]] ChosenLooks chosen_looks(const Session& session);

/// Returns the settings of what the window shows of `scene` if that is chosen.
Result<Looks> looks_of(const Session& session, const LoadedScene& scene, const ChosenLooks& chosen);

/// Likewise for what is chosen, of `session.scene`, which is not null.
Result<Looks> looks_of(const Session& session);

}  // namespace relief
