// Hears what OpenGL is told to make, to bind and to draw: for `--explain` and for counting bytes.
#pragma once

// clang-format off: this order, because glcorearb.h is only types here
#include <GL/glcorearb.h>
// clang-format on

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/explanation/explanation.h"
#include "renderer/gl/shader/features.h"

namespace relief {

struct Gl;

/// Keeps what exists in one context and what its last frame did. The functions of `Gl` tell it
/// (RELIEF_GL_HEARD_FUNCTIONS): whoever calls them need not know of it. A function that gives a
/// buffer or a texture its storage must be among those.
class GlRecorder {
 public:
  /// From here on everything belongs to a new frame.
  void begin_frame();

  /// What exists, and what the frame did.
  [[nodiscard]] Explanation explain() const;

  /// A program was linked. `lines`: as Explanation::Variant has them.
  void add_program(GLuint id, std::string_view name, std::string_view vertex,
                   std::string_view fragment, Features features, std::uint64_t lines);
  /// Asks OpenGL through these functions how large textures are.
  void ask(PFNGLGETTEXTURELEVELPARAMETERIVPROC level_parameter,
           PFNGLGETTEXTUREPARAMETERIVPROC parameter) {
    level_parameter_ = level_parameter;
    parameter_ = parameter;
  }

  // As the OpenGL functions of similar names.
  void name_object(GLenum kind, GLuint id, GLsizei length, const GLchar* label);
  void store_buffer(GLuint id, GLsizeiptr bytes, const void* contents, GLbitfield flags);
  void store_texture_2d(GLuint id, GLsizei levels, GLenum format, GLsizei width, GLsizei height);
  void store_texture_3d(GLuint id, GLsizei levels, GLenum format, GLsizei width, GLsizei height,
                        GLsizei depth);
  void delete_buffers(GLsizei count, const GLuint* ids);
  void delete_textures(GLsizei count, const GLuint* ids);
  void attach_buffer(GLuint texture, GLenum format, GLuint buffer);
  void attach_texture(GLuint framebuffer, GLenum attachment, GLuint texture, GLint level);
  void attach_elements(GLuint vertex_array, GLuint buffer);
  void attach_vertices(GLuint vertex_array, GLuint binding, GLuint buffer, GLintptr offset,
                       GLsizei stride);
  void bind_buffer(GLenum target, GLuint buffer);
  void bind_buffer_base(GLenum target, GLuint index, GLuint buffer);
  void bind_framebuffer(GLenum target, GLuint framebuffer);
  void bind_texture(GLuint unit, GLuint texture);
  void bind_vertex_array(GLuint vertex_array);
  void use_program(GLuint program);
  void begin_pass(GLenum source, GLuint id, GLsizei length, const GLchar* name);
  void end_pass();
  void enable(GLenum what);
  void disable(GLenum what);
  void draw_arrays(GLenum mode, GLint first, GLsizei count);
  void draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices);
  void draw_many_arrays(GLenum mode, const void* commands, GLsizei count, GLsizei stride);
  void draw_many_elements(GLenum mode, GLenum type, const void* commands, GLsizei count,
                          GLsizei stride);

 private:
  struct Object {
    Explanation::Memory memory;
    GLuint shows = 0;  ///< a texture: the buffer that it shows, or 0
  };
  using Objects = std::map<GLuint, Object>;
  struct Variant {
    Explanation::Variant variant;
    Features features = 0;
  };

  void measure_texture(GLuint id, GLsizei levels);
  void erase(Objects& objects, std::vector<Explanation::Memory>& gone, GLsizei count,
             const GLuint* ids);
  void mark_buffer(GLuint id);
  void mark_texture(GLuint id);
  void add_draw(GLenum mode, std::uint64_t commands);

  PFNGLGETTEXTURELEVELPARAMETERIVPROC level_parameter_ = nullptr;
  PFNGLGETTEXTUREPARAMETERIVPROC parameter_ = nullptr;
  Objects buffers_;
  Objects textures_;
  std::map<GLuint, Variant> programs_;
  std::map<GLuint, std::map<GLenum, GLuint>> framebuffers_;  ///< textures by attachment
  std::map<GLuint, std::map<GLint, GLuint>> vertex_arrays_;  ///< buffers by binding; -1: elements

  // What is bound now.
  std::map<GLuint, GLuint> units_;
  std::map<std::pair<GLenum, GLuint>, GLuint> bases_;
  GLuint commands_ = 0;
  GLuint framebuffer_ = 0;
  GLuint vertex_array_ = 0;
  GLuint program_ = 0;
  bool culls_ = false;
  std::string pass_;

  // What the frame did.
  std::vector<std::string> passes_;
  std::vector<Explanation::Draw> draws_;
  std::vector<Explanation::Memory> gone_buffers_;  ///< bound and deleted since
  std::vector<Explanation::Memory> gone_textures_;
};

}  // namespace relief
