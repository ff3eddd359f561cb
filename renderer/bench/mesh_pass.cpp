#include "renderer/bench/mesh_pass.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/patch.h"
#include "renderer/frame/features.h"
#include "renderer/gl/program.h"
#include "renderer/view/uniforms.h"
#include "shaders/include/shared.h"

namespace relief::bench_passes {
namespace {

struct Vertex {
  glm::vec3 position;  ///< from the middle of the mesh
  glm::vec3 normal;
};

Features mesh_features(const RenderSettings& settings, const TriangleMesh& mesh) {
  return scene_features(settings, !mesh.colours.empty())
      .without(RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_FRONT);
}

/// A near plane in front of all that can be told apart: a part of the mesh's size, as the spacing
/// of patches is.
double near_spacing(const Bounds& bounds) {
  const double size = glm::distance(bounds.min, bounds.max);
  return size > 0.0 ? 1e-3 * size : 1.0;
}

/// The mesh on the GPU.
struct Uploaded {
  StoredPatch frame;  ///< of the positions: a "patch" with spacing 1 along the world's axes
  GLsizei indices = 0;
  Buffer vertices;
  std::optional<Buffer> colours;
  Buffer elements;
  VertexArray layout;
};

Uploaded upload(const Gl& gl, const TriangleMesh& mesh, const Bounds& bounds, bool coloured) {
  StoredPatch frame;
  frame.origin = 0.5 * (bounds.min + bounds.max);
  std::vector<Vertex> vertices;
  vertices.reserve(mesh.positions.size());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k)
    vertices.push_back({glm::vec3(mesh.positions[k] - frame.origin), mesh.normals[k]});
  Uploaded made{frame,
                static_cast<GLsizei>(3 * mesh.triangles.size()),
                make_buffer(gl, "mesh vertices", std::span<const Vertex>(vertices)),
                std::nullopt,
                make_buffer(gl, "mesh indices", std::span<const Triangle>(mesh.triangles)),
                VertexArray(gl, "mesh")};
  const GLuint id = made.layout.id();
  const auto add_attribute = [&gl, id](GLuint location, GLuint binding, std::size_t offset) {
    gl.EnableVertexArrayAttrib(id, location);
    gl.VertexArrayAttribFormat(id, location, 3, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.VertexArrayAttribBinding(id, location, binding);
  };
  gl.VertexArrayVertexBuffer(id, 0, made.vertices.id(), 0, sizeof(Vertex));
  gl.VertexArrayElementBuffer(id, made.elements.id());
  add_attribute(RELIEF_ATTRIBUTE_POSITION, 0, offsetof(Vertex, position));
  add_attribute(RELIEF_ATTRIBUTE_NORMAL, 0, offsetof(Vertex, normal));
  if (!coloured) return made;
  const std::vector<glm::vec3> colours(mesh.colours.begin(), mesh.colours.end());
  made.colours = make_buffer(gl, "mesh colours", std::span<const glm::vec3>(colours));
  gl.VertexArrayVertexBuffer(id, 1, made.colours->id(), 0, sizeof(glm::vec3));
  add_attribute(RELIEF_ATTRIBUTE_COLOUR, 1, 0);
  return made;
}

void draw_mesh(const Gl& gl, const Uploaded& mesh, const Program& program, const Table& view,
               const GlFrame& frame, PassTimer& timer) {
  const ScopedPass pass(gl, timer, "mesh");
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.UseProgram(program.id());
  gl.BindVertexArray(mesh.layout.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_PATCH_VIEWS, view.texture.id());
  if (frame.environment != nullptr)
    gl.BindTextureUnit(RELIEF_TEXTURE_ENVIRONMENT, frame.environment->id());
  gl.DrawElements(GL_TRIANGLES, mesh.indices, GL_UNSIGNED_INT, nullptr);
  gl.BindTextureUnit(RELIEF_TEXTURE_ENVIRONMENT, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PATCH_VIEWS, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_DEPTH_TEST);
}

class MeshDrawing final : public GlDrawing {
 public:
  MeshDrawing(const Gl& gl, const Uploaded& mesh, const Program& program, Table view)
      : gl_(gl), mesh_(mesh), program_(program), view_(std::move(view)) {}

  void draw(const GlFrame& frame, PassTimer& timer) const override {
    draw_mesh(gl_, mesh_, program_, view_, frame, timer);
  }

 private:
  const Gl& gl_;
  const Uploaded& mesh_;
  const Program& program_;
  Table view_;  ///< the camera relative to the mesh
};

class PreparedMesh final : public GlPreparedModel {
 public:
  PreparedMesh(std::unique_ptr<GlModel> model, Uploaded mesh, Program program, Program counting)
      : GlPreparedModel(std::move(model)),
        mesh_(std::move(mesh)),
        program_(std::move(program)),
        counting_(std::move(counting)) {}

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                  const RenderSettings& /*settings*/,
                                                  Counting counting) override {
    const shared::PatchView seen = view_patch(frame.view, mesh_.frame);
    return std::unique_ptr<GlDrawing>(std::make_unique<MeshDrawing>(
        model().gl(), mesh_, counting == Counting::On ? counting_ : program_,
        make_table(model().gl(), "mesh view", GL_RGBA32F,
                   std::span<const shared::PatchView>(&seen, 1))));
  }

 private:
  Uploaded mesh_;
  Program program_;
  Program counting_;
};

}  // namespace

Result<std::unique_ptr<GlPreparedModel>> prepare_mesh(std::shared_ptr<const OpenGl> opengl,
                                                      const TriangleMesh& mesh,
                                                      const RenderSettings& settings) {
  if (mesh.triangles.size() > std::numeric_limits<GLsizei>::max() / 3)
    return make_error("the mesh has {} triangles, more than one draw can have ({})",
                      mesh.triangles.size(), std::numeric_limits<GLsizei>::max() / 3);
  const Bounds bounds = bounds_of(mesh.positions);
  // What images need beside the mesh comes with a model; this one has no patches.
  PatchModel nothing;
  nothing.spacing = near_spacing(bounds);
  nothing.bounds = bounds;
  auto on_gpu = GlModel::create({.opengl = std::move(opengl),
                                 .environments = std::make_shared<EnvironmentCache>(),
                                 .patches = nothing});
  if (!on_gpu) return on_gpu.error();
  const Gl& gl = (*on_gpu)->gl();
  const Features features = mesh_features(settings, mesh);
  const auto make = [&](Features bits) {
    return make_program(gl, "mesh", "bench/mesh.vert", "bench/mesh.frag", bits);
  };
  RELIEF_TRY_ASSIGN(auto program, make(features));
  RELIEF_TRY_ASSIGN(auto counting, make(features | RELIEF_FEATURE_COUNT_FRAGMENTS));
  Uploaded uploaded = upload(gl, mesh, bounds, features.has(RELIEF_FEATURE_COLOURS));
  RELIEF_TRY(check_errors(gl, "the mesh"));
  return std::unique_ptr<GlPreparedModel>(std::make_unique<PreparedMesh>(
      std::move(*on_gpu), std::move(uploaded), std::move(program), std::move(counting)));
}

}  // namespace relief::bench_passes
