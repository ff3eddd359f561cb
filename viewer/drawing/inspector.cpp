#include "viewer/drawing/inspector.h"

#include <optional>
#include <span>
#include <vector>

#include "common/image/srgb.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/program.h"
#include "renderer/store/patch_store.h"
#include "shaders/include/shared.h"
#include "viewer/inspecting/inspection_colours.h"

namespace relief {
namespace {

Texture make_colours(const Gl& gl, Inspection what) {
  std::vector<glm::vec4> texels;
  for (const glm::u8vec3 colour : colours_of(what))
    texels.emplace_back(linear_from_srgb8(colour), 1.0F);
  const auto width = static_cast<std::uint32_t>(texels.size());
  Texture texture = make_attachment(gl, "inspection colours", GL_RGBA32F, width, 1);
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(width), 1, GL_RGBA, GL_FLOAT,
                       texels.data());
  return texture;
}

void bind(const Gl& gl, GLuint unit, const Texture* texture) {
  gl.BindTextureUnit(unit, texture == nullptr ? 0 : texture->id());
}

}  // namespace

Result<Inspector> Inspector::create(const Gl& gl, Inspection what) {
  RELIEF_TRY_ASSIGN(Program program, make_program(gl, "inspect", "environment/screen.vert",
                                                  "viewer/inspect.frag", {}));
  Inspector made(gl, what, std::move(program), make_colours(gl, what));
  RELIEF_TRY(check_errors(gl, "the inspection"));
  return made;
}

void Inspector::count(const DrawnPart& part) {
  const Targets& targets = part.frame.targets;
  std::vector<std::uint32_t> counts(1 + std::size_t{targets.width} * targets.height);
  gl_->GetNamedBufferSubData(part.counts, 0,
                             static_cast<GLsizeiptr>(counts.size() * sizeof(std::uint32_t)),
                             counts.data());
  for (const std::uint32_t count : std::span(counts).subspan(1)) {
    figures_.fragments += count;
    figures_.covered += count > 0 ? 1 : 0;
  }
}

Status Inspector::draw(const DrawnPart& part, const Canvas& into) {
  const Gl& gl = *gl_;
  const Targets& targets = part.frame.targets;
  const Raster& raster = part.raster;
  std::optional<Table> levels;
  if (what_ == Inspection::Levels) {
    const std::vector<std::uint8_t> drawn = drawn_levels(part.store, part.frame.view);
    levels = make_table(gl, "levels drawn", GL_R8UI, std::span<const std::uint8_t>(drawn));
  }
  if (part.counts != 0) count(part);
  PassTimer timer(gl);
  const ScopedPass pass(gl, timer, "inspect");
  const GLuint program = program_.id();
  gl.BindFramebuffer(GL_FRAMEBUFFER, into.framebuffer.id());
  gl.Viewport(static_cast<GLint>(raster.left), static_cast<GLint>(raster.bottom),
              static_cast<GLsizei>(raster.width), static_cast<GLsizei>(raster.height));
  gl.Disable(GL_DEPTH_TEST);
  gl.UseProgram(program);
  gl.ProgramUniform1i(program, RELIEF_UNIFORM_INSPECTION, *inspected_output(what_));
  gl.ProgramUniform3i(program, RELIEF_UNIFORM_INSPECTED_PART, static_cast<GLint>(raster.left),
                      static_cast<GLint>(raster.bottom), static_cast<GLint>(raster.side));
  const glm::vec3 toward(part.frame.view.rotation[0].z, part.frame.view.rotation[1].z,
                         part.frame.view.rotation[2].z);
  gl.ProgramUniform3f(program, RELIEF_UNIFORM_TOWARD_EYE, toward.x, toward.y, toward.z);
  gl.ProgramUniform1f(program, RELIEF_UNIFORM_SCALE_END, static_cast<float>(kMostFragments));
  bind(gl, RELIEF_TEXTURE_INSPECTED_COLOUR, &targets.colour);
  bind(gl, RELIEF_TEXTURE_INSPECTED_NORMAL, address(targets.normal));
  bind(gl, RELIEF_TEXTURE_INSPECTED_UV, address(targets.uv));
  bind(gl, RELIEF_TEXTURE_INSPECTED_PATCH, address(targets.patch_id));
  bind(gl, RELIEF_TEXTURE_INSPECTED_LEVELS, levels ? &levels->texture : nullptr);
  bind(gl, RELIEF_TEXTURE_INSPECTION_COLOURS, &colours_);
  if (part.counts != 0)
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, part.counts);
  gl.BindVertexArray(nothing_.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindVertexArray(0);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, 0);
  for (GLuint unit = 0; unit <= RELIEF_TEXTURE_INSPECTION_COLOURS; ++unit) bind(gl, unit, nullptr);
  gl.UseProgram(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  return check_errors(gl, "the inspection");
}

}  // namespace relief
