// OpenGL objects that delete themselves, each with a label that debuggers and messages show.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "renderer/gl/functions.h"

namespace relief {

/// One OpenGL object. `Kind` says how it is made and deleted.
template <class Kind>
class GlObject {
 public:
  /// Makes the object; `arguments` go to Kind::create.
  template <class... Arguments>
  GlObject(const Gl& gl, std::string_view label, Arguments... arguments)
      : gl_(&gl), id_(Kind::create(gl, arguments...)) {
    gl.ObjectLabel(Kind::kIdentifier, id_, static_cast<GLsizei>(label.size()), label.data());
  }
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (id_ != 0) Kind::destroy(*gl_, id_);
  }

  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const Gl* gl_;
  GLuint id_;
};

namespace detail {

/// Objects that glCreate...s and glDelete...s make and delete several at a time.
template <GLenum Identifier, auto Create, auto Delete>
struct PluralKind {
  static constexpr GLenum kIdentifier = Identifier;
  static GLuint create(const Gl& gl) {
    GLuint id = 0;
    (gl.*Create)(1, &id);
    return id;
  }
  static void destroy(const Gl& gl, GLuint id) { (gl.*Delete)(1, &id); }
};

struct TextureKind {
  static constexpr GLenum kIdentifier = GL_TEXTURE;
  static GLuint create(const Gl& gl, GLenum target) {
    GLuint id = 0;
    gl.CreateTextures(target, 1, &id);
    return id;
  }
  static void destroy(const Gl& gl, GLuint id) { gl.DeleteTextures(1, &id); }
};

struct QueryKind {
  static constexpr GLenum kIdentifier = GL_QUERY;
  static GLuint create(const Gl& gl, GLenum target) {
    // Not glCreateQueries: Mesa 22.3's knows no pipeline statistics. The first use makes the query.
    GLuint id = 0;
    gl.GenQueries(1, &id);
    gl.BeginQuery(target, id);
    gl.EndQuery(target);
    return id;
  }
  static void destroy(const Gl& gl, GLuint id) { gl.DeleteQueries(1, &id); }
};

struct ProgramKind {
  static constexpr GLenum kIdentifier = GL_PROGRAM;
  static GLuint create(const Gl& gl) { return gl.CreateProgram(); }
  static void destroy(const Gl& gl, GLuint id) { gl.DeleteProgram(id); }
};

}  // namespace detail

using Buffer = GlObject<detail::PluralKind<GL_BUFFER, &Gl::CreateBuffers, &Gl::DeleteBuffers>>;
using Texture = GlObject<detail::TextureKind>;
using Framebuffer =
    GlObject<detail::PluralKind<GL_FRAMEBUFFER, &Gl::CreateFramebuffers, &Gl::DeleteFramebuffers>>;
using VertexArray =
    GlObject<detail::PluralKind<GL_VERTEX_ARRAY, &Gl::CreateVertexArrays, &Gl::DeleteVertexArrays>>;
using Query = GlObject<detail::QueryKind>;
using Program = GlObject<detail::ProgramKind>;

/// A buffer with these contents, at least one element long (OpenGL has no empty buffers).
/// `flags` as for glNamedBufferStorage: GL_DYNAMIC_STORAGE_BIT if its contents will change.
template <class T>
Buffer make_buffer(const Gl& gl, std::string_view label, std::span<const T> contents,
                   GLbitfield flags = 0) {
  static const T nothing{};
  Buffer buffer(gl, label);
  const std::size_t bytes = contents.empty() ? sizeof(T) : contents.size_bytes();
  gl.NamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(bytes),
                        contents.empty() ? &nothing : contents.data(), flags);
  return buffer;
}

/// A buffer that shaders read as a texture of one row.
struct Table {
  Buffer buffer;
  Texture texture;
};

/// A table with these contents, its texels of format `texel` (GL_RGBA32F and the like).
template <class T>
Table make_table(const Gl& gl, std::string_view label, GLenum texel, std::span<const T> contents,
                 GLbitfield flags = 0) {
  Table table{make_buffer(gl, label, contents, flags),
              Texture(gl, label, GLenum{GL_TEXTURE_BUFFER})};
  gl.TextureBuffer(table.texture.id(), texel, table.buffer.id());
  return table;
}

}  // namespace relief
