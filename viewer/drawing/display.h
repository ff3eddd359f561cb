// The window's picture: what is on the GPU, how it is drawn and shown.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "common/error.h"
#include "common/image/image.h"
#include "renderer/gl/context/loader.h"
#include "renderer/gl/open_gl.h"
#include "viewer/drawing/collect_job.h"
#include "viewer/drawing/inspector.h"
#include "viewer/drawing/live_picture.h"
#include "viewer/drawing/pacer.h"
#include "viewer/drawing/point_cloud.h"
#include "viewer/drawing/presenter.h"
#include "viewer/drawing/uploaded_scene.h"
#include "viewer/session.h"

namespace relief {

/// Draws a session into the window whose OpenGL context is current. Everything it holds goes before
/// the context does.
class Display {
 public:
  static Result<std::unique_ptr<Display>> create(const GlLoader& load);

  /// Uploads what has arrived, which then is what is drawn, and puts it into the session. If that
  /// fails, what was there before stays. `collected`: what a job of collect() has made of it.
  Status show(std::shared_ptr<const LoadedScene> scene, Session& session,
              CollectedStore* collected = nullptr);
  Status show(const ScanPoints& points);

  /// Whether uploading a scene for the session's looks takes so long that collect() is to come
  /// first. Not if they can't be drawn, which show() will say.
  [[nodiscard]] bool is_slow_to_show(const LoadedScene& scene, const Session& session) const;

  /// Begins to collect what show() will upload of a scene. Null if the looks can't be drawn.
  [[nodiscard]] std::unique_ptr<CollectJob> collect(std::shared_ptr<const LoadedScene> scene,
                                                    const Session& session) const;

  /// Takes what is shown off the GPU and out of the session.
  void show_nothing(Session& session);

  /// Makes the picture newer: all of it and coarsely if something `changes`, otherwise the next
  /// part of the full picture. A look for which much has to be collected is collected for in the
  /// background; until then the picture has the look before. A look that cannot be drawn fails, and
  /// is put back in the session.
  Status update(Session& session, bool changes);

  /// Whether a look is being collected for, and whether that is done. Then set
  /// Session::look_changed: update() shows the look.
  [[nodiscard]] bool is_collecting() const { return collecting_ != nullptr; }
  [[nodiscard]] bool has_collected() const { return is_collecting() && collecting_->is_done(); }

  /// Takes what was read of a scene that is read as views need it: while something `moves`, as fine
  /// as moving pictures show it. Returns whether there is more to draw or to refine.
  Result<bool> stream(Session& session, bool moves);

  /// Shows the newest picture in the window.
  void present(const Session& session);

  /// Tells the pace of moving pictures what the last took until it was in the window. Returns
  /// whether the next ones will take about as long: one that compiles or uploads tells nothing.
  bool note_frame(double ms);

  /// Whether there is nothing left to refine.
  [[nodiscard]] bool is_complete() const { return picture_.is_complete(); }
  /// Whether nothing has been opened yet.
  [[nodiscard]] bool is_empty() const { return scene_ == nullptr && !points_; }
  /// Whether stream() has something to do although the view rests.
  [[nodiscard]] bool has_tiles_to_take() const {
    return scene_ != nullptr && scene_->stream() != nullptr && scene_->stream()->has_news();
  }
  [[nodiscard]] Pacer& pacer() { return pacer_; }
  [[nodiscard]] const UploadedScene* scene() const { return scene_.get(); }

  [[nodiscard]] const Gl& gl() const { return opengl_->gl(); }

  /// The newest picture; null before the first.
  [[nodiscard]] const Canvas* picture() const { return picture_.shown(); }

  /// The pixel below a cursor as Viewport::probe gives it. Nothing without a scene or beside it.
  [[nodiscard]] std::optional<Image> probe(const Session& session, glm::dvec2 cursor);

 private:
  explicit Display(GlLoader load, std::shared_ptr<const OpenGl> opengl)
      : load_(std::move(load)), opengl_(std::move(opengl)), picture_(opengl_->gl()) {}
  [[nodiscard]] ChosenLooks shown_looks(const Session& session) const;
  [[nodiscard]] Result<Looks> drawn_looks(const Session& session) const;
  Status draw(Session& session, bool changes);
  Status encode(const Session& session, const Rows& rows);
  Status change_look(Session& session);
  bool collects(const Session& session);
  Status prepare(Session& session, CollectedStore* collected);
  Status choose_inspector(Inspection inspection);
  void note_figures(Session& session) const;

  GlLoader load_;
  std::shared_ptr<const OpenGl> opengl_;
  std::optional<Presenter> presenter_;
  std::unique_ptr<UploadedScene> scene_;
  std::optional<PointCloud> points_;
  std::optional<Inspector> inspector_;  ///< only while the session's inspection needs it
  LivePicture picture_;
  Pacer pacer_{33.0};                       ///< its target is the session's
  double depth_scale_ = 0.0;                ///< of the newest picture (Presentation::depth_scale)
  bool is_steady_ = false;                  ///< the next frame compiles and uploads nothing
  bool is_stale_ = false;                   ///< patches have come that the picture at rest has not
  ChosenLooks ready_;                       ///< what was drawn last; all that it needs is uploaded
  std::unique_ptr<CollectJob> collecting_;  ///< for what is chosen instead
};

}  // namespace relief
