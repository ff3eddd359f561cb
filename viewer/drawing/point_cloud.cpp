#include "viewer/drawing/point_cloud.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/ext/matrix_transform.hpp>
#include <span>

#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/program.h"
#include "renderer/view/view.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Points overlap a little, so that a surface of them looks closed.
constexpr double kOverlap = 1.4;
constexpr float kFewestPixels = 1.5F;
constexpr float kMostPixels = 16.0F;

/// As a share of the spacing.
constexpr double kNear = 0.01;

shared::PointFrame frame_of(const View& view, const glm::dvec3& origin, double size) {
  const glm::dmat4 from_world = glm::dmat4(view.rotation);
  const glm::dmat4 clip = view.projection * glm::translate(from_world, origin - view.eye);
  const double pixels = size * view.height / (2.0 * view.slope_y);
  return {glm::mat4(clip), {static_cast<float>(pixels), kFewestPixels, kMostPixels, 0.0F}};
}

}  // namespace

PointCloud::PointCloud(const Gl& gl, const ScanPoints& points, Program program)
    : gl_(&gl),
      program_(std::move(program)),
      points_(make_buffer(gl, "scan points", std::span<const ShownPoint>(points.points))),
      frame_(make_buffer(gl, "scan points' frame",
                         std::span<const shared::PointFrame>(std::array<shared::PointFrame, 1>{}),
                         GL_DYNAMIC_STORAGE_BIT)),
      vertices_(gl, "scan points"),
      origin_(points.origin),
      spacing_(points.spacing),
      is_lit_(points.is_lit),
      count_(points.points.size()) {
  const GLuint id = vertices_.id();
  gl.VertexArrayVertexBuffer(id, 0, points_.id(), 0, sizeof(ShownPoint));
  gl.EnableVertexArrayAttrib(id, RELIEF_ATTRIBUTE_POSITION);
  gl.VertexArrayAttribFormat(id, RELIEF_ATTRIBUTE_POSITION, 3, GL_FLOAT, GL_FALSE,
                             offsetof(ShownPoint, position));
  gl.VertexArrayAttribBinding(id, RELIEF_ATTRIBUTE_POSITION, 0);
  gl.EnableVertexArrayAttrib(id, RELIEF_ATTRIBUTE_COLOUR);
  gl.VertexArrayAttribFormat(id, RELIEF_ATTRIBUTE_COLOUR, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                             offsetof(ShownPoint, colour));
  gl.VertexArrayAttribBinding(id, RELIEF_ATTRIBUTE_COLOUR, 0);
}

Result<PointCloud> PointCloud::create(const Gl& gl, const ScanPoints& points) {
  RELIEF_TRY_ASSIGN(Program program, make_program(gl, "scan points", "viewer/points.vert",
                                                  "viewer/points.frag", {}));
  PointCloud made(gl, points, std::move(program));
  RELIEF_TRY(check_errors(gl, "the points of the scan"));
  return made;
}

void PointCloud::draw(const Camera& camera, const glm::vec3& background, double share,
                      const Canvas& into) const {
  const Gl& gl = *gl_;
  PassTimer timer(gl);
  const ScopedPass pass(gl, timer, "scan points");
  const DepthNeeds needs{kNear * spacing_, {}, spacing_};
  const View view = make_view(camera, into.width, into.height, needs);
  const shared::PointFrame frame = frame_of(view, origin_, kOverlap * spacing_ / std::sqrt(share));
  gl.NamedBufferSubData(frame_.id(), 0, sizeof(frame), &frame);
  const std::array<float, 4> colour{background.x, background.y, background.z, 0.0F};
  const float infinite = 0.0F;
  gl.ClearNamedFramebufferfv(into.framebuffer.id(), GL_COLOR, RELIEF_OUT_COLOUR, colour.data());
  gl.ClearNamedFramebufferfv(into.framebuffer.id(), GL_DEPTH, 0, &infinite);
  gl.BindFramebuffer(GL_FRAMEBUFFER, into.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(into.width), static_cast<GLsizei>(into.height));
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, frame_.id());
  gl.UseProgram(program_.id());
  gl.BindVertexArray(vertices_.id());
  gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(std::ceil(share * static_cast<double>(count_))));
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, 0);
  gl.Disable(GL_PROGRAM_POINT_SIZE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_DEPTH_TEST);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace relief
