// The OpenGL functions that Relief calls, loaded from a context into a plain struct.
#pragma once

// clang-format off: this order, because glcorearb.h is only types here
#include <GL/glcorearb.h>
// clang-format on

#include "common/error.h"
#include "renderer/gl/recorder.h"

namespace relief {

class GlContext;

/// Functions that make, draw or bind nothing, as F(type, name without "gl"). OpenGL 4.5 core,
/// direct state access.
#define RELIEF_GL_FUNCTIONS(F)                                         \
  F(PFNGLATTACHSHADERPROC, AttachShader)                               \
  F(PFNGLBEGINQUERYPROC, BeginQuery)                                   \
  F(PFNGLBLENDEQUATIONSEPARATEPROC, BlendEquationSeparate)             \
  F(PFNGLBLENDFUNCPROC, BlendFunc)                                     \
  F(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                     \
  F(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)               \
  F(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus) \
  F(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)         \
  F(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)       \
  F(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                           \
  F(PFNGLCLIPCONTROLPROC, ClipControl)                                 \
  F(PFNGLCOLORMASKPROC, ColorMask)                                     \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                             \
  F(PFNGLCOPYIMAGESUBDATAPROC, CopyImageSubData)                       \
  F(PFNGLCOPYNAMEDBUFFERSUBDATAPROC, CopyNamedBufferSubData)           \
  F(PFNGLCREATEBUFFERSPROC, CreateBuffers)                             \
  F(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                   \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                             \
  F(PFNGLCREATESHADERPROC, CreateShader)                               \
  F(PFNGLCREATETEXTURESPROC, CreateTextures)                           \
  F(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                   \
  F(PFNGLCULLFACEPROC, CullFace)                                       \
  F(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)               \
  F(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                   \
  F(PFNGLDELETEPROGRAMPROC, DeleteProgram)                             \
  F(PFNGLDELETEQUERIESPROC, DeleteQueries)                             \
  F(PFNGLDELETESHADERPROC, DeleteShader)                               \
  F(PFNGLDELETESYNCPROC, DeleteSync)                                   \
  F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                   \
  F(PFNGLDEPTHFUNCPROC, DepthFunc)                                     \
  F(PFNGLDEPTHMASKPROC, DepthMask)                                     \
  F(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)         \
  F(PFNGLENDQUERYPROC, EndQuery)                                       \
  F(PFNGLFENCESYNCPROC, FenceSync)                                     \
  F(PFNGLFINISHPROC, Finish)                                           \
  F(PFNGLFRONTFACEPROC, FrontFace)                                     \
  F(PFNGLGENQUERIESPROC, GenQueries)                                   \
  F(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)             \
  F(PFNGLGETBOOLEANVPROC, GetBooleanv)                                 \
  F(PFNGLGETERRORPROC, GetError)                                       \
  F(PFNGLGETFLOATVPROC, GetFloatv)                                     \
  F(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)           \
  F(PFNGLGETINTEGERVPROC, GetIntegerv)                                 \
  F(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)             \
  F(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                     \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                               \
  F(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                 \
  F(PFNGLGETQUERYIVPROC, GetQueryiv)                                   \
  F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                       \
  F(PFNGLGETSHADERIVPROC, GetShaderiv)                                 \
  F(PFNGLGETSTRINGPROC, GetString)                                     \
  F(PFNGLGETTEXTUREIMAGEPROC, GetTextureImage)                         \
  F(PFNGLGETTEXTURELEVELPARAMETERIVPROC, GetTextureLevelParameteriv)   \
  F(PFNGLGETTEXTUREPARAMETERIVPROC, GetTextureParameteriv)             \
  F(PFNGLISENABLEDPROC, IsEnabled)                                     \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                                 \
  F(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                             \
  F(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                   \
  F(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers) \
  F(PFNGLPIXELSTOREIPROC, PixelStorei)                                 \
  F(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                       \
  F(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                       \
  F(PFNGLPROGRAMUNIFORM3FPROC, ProgramUniform3f)                       \
  F(PFNGLPROGRAMUNIFORM3IPROC, ProgramUniform3i)                       \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                               \
  F(PFNGLTEXTUREBARRIERPROC, TextureBarrier)                           \
  F(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                     \
  F(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                     \
  F(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                     \
  F(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)       \
  F(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)         \
  F(PFNGLVERTEXARRAYATTRIBIFORMATPROC, VertexArrayAttribIFormat)       \
  F(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)     \
  F(PFNGLVIEWPORTPROC, Viewport)

/// Those that a recorder hears of, with the name under which it does (renderer/gl/recorder.h).
#define RELIEF_GL_HEARD_FUNCTIONS(F)                                                   \
  F(PFNGLBINDBUFFERPROC, BindBuffer, bind_buffer)                                      \
  F(PFNGLBINDBUFFERBASEPROC, BindBufferBase, bind_buffer_base)                         \
  F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer, bind_framebuffer)                       \
  F(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit, bind_texture)                           \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray, bind_vertex_array)                      \
  F(PFNGLDELETEBUFFERSPROC, DeleteBuffers, delete_buffers)                             \
  F(PFNGLDELETETEXTURESPROC, DeleteTextures, delete_textures)                          \
  F(PFNGLDISABLEPROC, Disable, disable)                                                \
  F(PFNGLDRAWARRAYSPROC, DrawArrays, draw_arrays)                                      \
  F(PFNGLDRAWELEMENTSPROC, DrawElements, draw_elements)                                \
  F(PFNGLENABLEPROC, Enable, enable)                                                   \
  F(PFNGLMULTIDRAWARRAYSINDIRECTPROC, MultiDrawArraysIndirect, draw_many_arrays)       \
  F(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, MultiDrawElementsIndirect, draw_many_elements) \
  F(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage, store_buffer)                     \
  F(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture, attach_texture)         \
  F(PFNGLOBJECTLABELPROC, ObjectLabel, name_object)                                    \
  F(PFNGLPOPDEBUGGROUPPROC, PopDebugGroup, end_pass)                                   \
  F(PFNGLPUSHDEBUGGROUPPROC, PushDebugGroup, begin_pass)                               \
  F(PFNGLTEXTUREBUFFERPROC, TextureBuffer, attach_buffer)                              \
  F(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D, store_texture_2d)                     \
  F(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D, store_texture_3d)                     \
  F(PFNGLUSEPROGRAMPROC, UseProgram, use_program)                                      \
  F(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer, attach_elements)      \
  F(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer, attach_vertices)

/// A function that the recorder, if there is one, hears of.
template <class Pointer, auto Hear>
class HeardFunction;
template <class... Arguments, auto Hear>
class HeardFunction<void(APIENTRY*)(Arguments...), Hear> {
 public:
  using Pointer = void(APIENTRY*)(Arguments...);

  HeardFunction() = default;
  HeardFunction(Pointer function, GlRecorder* recorder)
      : function_(function), recorder_(recorder) {}

  void operator()(Arguments... arguments) const {
    function_(arguments...);
    if (recorder_ != nullptr) (recorder_->*Hear)(arguments...);
  }

 private:
  Pointer function_ = nullptr;
  GlRecorder* recorder_ = nullptr;
};

/// The functions of one context. Passed by reference; valid as long as the context is current.
struct Gl {
#define RELIEF_GL_MEMBER(type, name) type name = nullptr;
  RELIEF_GL_FUNCTIONS(RELIEF_GL_MEMBER)
#undef RELIEF_GL_MEMBER
// NOLINTNEXTLINE(bugprone-macro-parentheses): the name that a declaration declares
#define RELIEF_GL_MEMBER(type, name, hear) HeardFunction<type, &GlRecorder::hear> name;
  RELIEF_GL_HEARD_FUNCTIONS(RELIEF_GL_MEMBER)
#undef RELIEF_GL_MEMBER
  GlRecorder* recorder = nullptr;  ///< null: nobody listens
};

/// Loads the functions of the current context. Fails if it is older than OpenGL 4.5. The recorder,
/// if there is one, must outlive every copy of them.
Result<Gl> load_functions(const GlContext& context, GlRecorder* recorder = nullptr);

/// One integer limit of the context.
[[nodiscard]] GLint get_limit(const Gl& gl, GLenum name);

/// Whether OpenGL has reported an error since the last call, as one sentence about `job` ("the
/// patch store"). Running out of memory and a GPU that was reset are the only ones a user should
/// ever see.
Status check_errors(const Gl& gl, const char* job);

}  // namespace relief
