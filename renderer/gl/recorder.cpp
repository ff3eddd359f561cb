#include "renderer/gl/recorder.h"

#include <algorithm>
#include <utility>

#include "renderer/gl/shader/feature_names.h"

namespace relief {
namespace {

constexpr GLint kElements = -1;

std::string text_of(GLsizei length, const GLchar* text) {
  return {text, static_cast<std::size_t>(length)};
}

std::string name_of_mode(GLenum mode) {
  switch (mode) {
    case GL_POINTS:
      return "points";
    case GL_TRIANGLES:
      return "triangles";
    case GL_TRIANGLE_STRIP:
      return "triangle strip";
    default:
      return "primitives";
  }
}

}  // namespace

void GlRecorder::begin_frame() {
  for (auto* const objects : {&buffers_, &textures_}) {
    for (auto& [id, object] : *objects) object.memory.bound = false;
  }
  for (auto& [id, program] : programs_) program.variant.drawn = false;
  passes_.clear();
  draws_.clear();
  gone_buffers_.clear();
  gone_textures_.clear();
}

Explanation GlRecorder::explain() const {
  Explanation all;
  Features features;
  for (const auto& [id, program] : programs_) {
    if (program.variant.drawn) {
      features |= program.features.bits;
      features.lights = std::max(features.lights, program.features.lights);
    }
    all.variants.push_back(program.variant);
  }
  all.features = feature_names(features);
  for (const auto& [id, buffer] : buffers_) all.buffers.push_back(buffer.memory);
  all.buffers.insert(all.buffers.end(), gone_buffers_.begin(), gone_buffers_.end());
  for (const auto& [id, texture] : textures_) {
    if (texture.shows == 0) all.textures.push_back(texture.memory);
  }
  all.textures.insert(all.textures.end(), gone_textures_.begin(), gone_textures_.end());
  all.passes = passes_;
  all.draws = draws_;
  return all;
}

void GlRecorder::add_program(GLuint id, std::string_view name, std::string_view vertex,
                             std::string_view fragment, Features features, std::uint64_t lines) {
  programs_[id] = {{.name = std::string(name),
                    .vertex = std::string(vertex),
                    .fragment = std::string(fragment),
                    .features = feature_names(features),
                    .lines = lines},
                   features};
}

void GlRecorder::name_object(GLenum kind, GLuint id, GLsizei length, const GLchar* label) {
  // OpenGL gives the numbers of what was deleted to what is made next.
  if (kind == GL_BUFFER) buffers_[id] = {{text_of(length, label), 0, false, false}, 0};
  if (kind == GL_TEXTURE) textures_[id] = {{text_of(length, label), 0, false, false}, 0};
  if (kind == GL_FRAMEBUFFER) framebuffers_[id].clear();
  if (kind == GL_VERTEX_ARRAY) vertex_arrays_[id].clear();
}

void GlRecorder::store_buffer(GLuint id, GLsizeiptr bytes, const void* /*contents*/,
                              GLbitfield /*flags*/) {
  buffers_[id].memory.bytes = static_cast<std::uint64_t>(bytes);
}

void GlRecorder::store_texture_2d(GLuint id, GLsizei levels, GLenum /*format*/, GLsizei /*width*/,
                                  GLsizei /*height*/) {
  measure_texture(id, levels);
}

void GlRecorder::store_texture_3d(GLuint id, GLsizei levels, GLenum /*format*/, GLsizei /*width*/,
                                  GLsizei /*height*/, GLsizei /*depth*/) {
  measure_texture(id, levels);
}

void GlRecorder::measure_texture(GLuint id, GLsizei levels) {
  const auto ask_level = [&](GLint level, GLenum name) {
    GLint value = 0;
    level_parameter_(id, level, name, &value);
    return static_cast<std::uint64_t>(value);
  };
  GLint target = 0;
  parameter_(id, GL_TEXTURE_TARGET, &target);
  const std::uint64_t faces = target == GL_TEXTURE_CUBE_MAP ? 6 : 1;
  std::uint64_t bits = 0;
  for (const GLenum part : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                            GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE})
    bits += ask_level(0, part);
  std::uint64_t texels = 0;
  for (GLint level = 0; level < levels; ++level) {
    texels += faces * ask_level(level, GL_TEXTURE_WIDTH) * ask_level(level, GL_TEXTURE_HEIGHT) *
              ask_level(level, GL_TEXTURE_DEPTH);
  }
  textures_[id].memory.bytes = texels * bits / 8;
}

void GlRecorder::erase(Objects& objects, std::vector<Explanation::Memory>& gone, GLsizei count,
                       const GLuint* ids) {
  for (GLsizei i = 0; i < count; ++i) {
    const auto found = objects.find(ids[i]);
    if (found == objects.end()) continue;
    if (found->second.memory.bound && found->second.shows == 0)
      gone.push_back(found->second.memory);
    objects.erase(found);
  }
}

void GlRecorder::delete_buffers(GLsizei count, const GLuint* ids) {
  erase(buffers_, gone_buffers_, count, ids);
}

void GlRecorder::delete_textures(GLsizei count, const GLuint* ids) {
  erase(textures_, gone_textures_, count, ids);
}

void GlRecorder::attach_buffer(GLuint texture, GLenum /*format*/, GLuint buffer) {
  textures_[texture].shows = buffer;
}

void GlRecorder::attach_texture(GLuint framebuffer, GLenum attachment, GLuint texture,
                                GLint /*level*/) {
  framebuffers_[framebuffer][attachment] = texture;
  if (const auto found = textures_.find(texture); found != textures_.end())
    found->second.memory.target = true;
}

void GlRecorder::attach_elements(GLuint vertex_array, GLuint buffer) {
  vertex_arrays_[vertex_array][kElements] = buffer;
}

void GlRecorder::attach_vertices(GLuint vertex_array, GLuint binding, GLuint buffer,
                                 GLintptr /*offset*/, GLsizei /*stride*/) {
  vertex_arrays_[vertex_array][static_cast<GLint>(binding)] = buffer;
}

void GlRecorder::bind_buffer(GLenum target, GLuint buffer) {
  if (target == GL_DRAW_INDIRECT_BUFFER) commands_ = buffer;
}

void GlRecorder::bind_buffer_base(GLenum target, GLuint index, GLuint buffer) {
  bases_[{target, index}] = buffer;
}

void GlRecorder::bind_framebuffer(GLenum /*target*/, GLuint framebuffer) {
  framebuffer_ = framebuffer;
}

void GlRecorder::bind_texture(GLuint unit, GLuint texture) {
  units_[unit] = texture;
}

void GlRecorder::bind_vertex_array(GLuint vertex_array) {
  vertex_array_ = vertex_array;
}

void GlRecorder::use_program(GLuint program) {
  program_ = program;
}

void GlRecorder::begin_pass(GLenum /*source*/, GLuint /*id*/, GLsizei length, const GLchar* name) {
  pass_ = text_of(length, name);
  passes_.push_back(pass_);
}

void GlRecorder::end_pass() {
  pass_.clear();
}

void GlRecorder::enable(GLenum what) {
  if (what == GL_CULL_FACE) culls_ = true;
}

void GlRecorder::disable(GLenum what) {
  if (what == GL_CULL_FACE) culls_ = false;
}

void GlRecorder::draw_arrays(GLenum mode, GLint /*first*/, GLsizei /*count*/) {
  add_draw(mode, 1);
}

void GlRecorder::draw_elements(GLenum mode, GLsizei /*count*/, GLenum /*type*/,
                               const void* /*indices*/) {
  add_draw(mode, 1);
}

void GlRecorder::draw_many_arrays(GLenum mode, const void* /*commands*/, GLsizei count,
                                  GLsizei /*stride*/) {
  mark_buffer(commands_);
  add_draw(mode, static_cast<std::uint64_t>(count));
}

void GlRecorder::draw_many_elements(GLenum mode, GLenum /*type*/, const void* /*commands*/,
                                    GLsizei count, GLsizei /*stride*/) {
  mark_buffer(commands_);
  add_draw(mode, static_cast<std::uint64_t>(count));
}

void GlRecorder::mark_buffer(GLuint id) {
  if (const auto found = buffers_.find(id); found != buffers_.end())
    found->second.memory.bound = true;
}

void GlRecorder::mark_texture(GLuint id) {
  const auto found = textures_.find(id);
  if (found == textures_.end()) return;
  found->second.memory.bound = true;
  mark_buffer(found->second.shows);
}

void GlRecorder::add_draw(GLenum mode, std::uint64_t commands) {
  for (const auto& [unit, texture] : units_) mark_texture(texture);
  for (const auto& [attachment, texture] : framebuffers_[framebuffer_]) mark_texture(texture);
  for (const auto& [base, buffer] : bases_) mark_buffer(buffer);
  for (const auto& [binding, buffer] : vertex_arrays_[vertex_array_]) mark_buffer(buffer);
  Explanation::Draw draw{pass_, {}, name_of_mode(mode), commands, culls_};
  if (const auto found = programs_.find(program_); found != programs_.end()) {
    found->second.variant.drawn = true;
    draw.program = found->second.variant.name;
  }
  draws_.push_back(std::move(draw));
}

}  // namespace relief
