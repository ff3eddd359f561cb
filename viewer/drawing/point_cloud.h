// The points of a scan on OpenGL.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>

#include "common/error.h"
#include "common/scene/camera.h"
#include "renderer/gl/object.h"
#include "viewer/document/scan_points.h"
#include "viewer/drawing/canvas.h"

namespace relief {

/// Points of about the size of their spacing. No surface: they only bridge the time until there is
/// one.
class PointCloud {
 public:
  /// Uploads the points. Fails if OpenGL has no memory for them.
  static Result<PointCloud> create(const Gl& gl, const ScanPoints& points);

  /// Draws a share of the points, 0 to 1, spread over all of them and the larger the fewer they
  /// are. Clears what was there before to `background` (linear).
  void draw(const Camera& camera, const glm::vec3& background, double share,
            const Canvas& into) const;

  /// Whether the points' colours show their shape.
  [[nodiscard]] bool is_lit() const { return is_lit_; }

 private:
  PointCloud(const Gl& gl, const ScanPoints& points, Program program);

  const Gl* gl_;
  Program program_;
  Buffer points_;
  Buffer frame_;
  VertexArray vertices_;
  glm::dvec3 origin_;
  double spacing_;
  bool is_lit_;
  std::size_t count_;
};

}  // namespace relief
