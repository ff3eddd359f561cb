// The OpenGL functions that Relief calls, loaded from a context into a plain struct.
#pragma once

// clang-format off: this order, because glcorearb.h is only types here
#include <GL/glcorearb.h>
// clang-format on

#include "common/error.h"

namespace relief {

class GlContext;

/// Every function used, as F(type, name without "gl"). OpenGL 4.5 core, direct state access.
#define RELIEF_GL_FUNCTIONS(F)                                           \
  F(PFNGLATTACHSHADERPROC, AttachShader)                                 \
  F(PFNGLBEGINQUERYPROC, BeginQuery)                                     \
  F(PFNGLBINDBUFFERPROC, BindBuffer)                                     \
  F(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                             \
  F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                           \
  F(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                           \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                           \
  F(PFNGLBLENDFUNCPROC, BlendFunc)                                       \
  F(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)   \
  F(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)           \
  F(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)         \
  F(PFNGLCLIPCONTROLPROC, ClipControl)                                   \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                               \
  F(PFNGLCREATEBUFFERSPROC, CreateBuffers)                               \
  F(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                     \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                               \
  F(PFNGLCREATESHADERPROC, CreateShader)                                 \
  F(PFNGLCREATETEXTURESPROC, CreateTextures)                             \
  F(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                     \
  F(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)                 \
  F(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                               \
  F(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                     \
  F(PFNGLDELETEPROGRAMPROC, DeleteProgram)                               \
  F(PFNGLDELETEQUERIESPROC, DeleteQueries)                               \
  F(PFNGLDELETESHADERPROC, DeleteShader)                                 \
  F(PFNGLDELETETEXTURESPROC, DeleteTextures)                             \
  F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                     \
  F(PFNGLDEPTHFUNCPROC, DepthFunc)                                       \
  F(PFNGLDEPTHMASKPROC, DepthMask)                                       \
  F(PFNGLDISABLEPROC, Disable)                                           \
  F(PFNGLDRAWARRAYSPROC, DrawArrays)                                     \
  F(PFNGLENABLEPROC, Enable)                                             \
  F(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)           \
  F(PFNGLENDQUERYPROC, EndQuery)                                         \
  F(PFNGLFINISHPROC, Finish)                                             \
  F(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)               \
  F(PFNGLGENQUERIESPROC, GenQueries)                                     \
  F(PFNGLGETERRORPROC, GetError)                                         \
  F(PFNGLGETFLOATVPROC, GetFloatv)                                       \
  F(PFNGLGETINTEGERVPROC, GetIntegerv)                                   \
  F(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)               \
  F(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                       \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                 \
  F(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                   \
  F(PFNGLGETQUERYIVPROC, GetQueryiv)                                     \
  F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                         \
  F(PFNGLGETSHADERIVPROC, GetShaderiv)                                   \
  F(PFNGLGETSTRINGPROC, GetString)                                       \
  F(PFNGLGETTEXTUREIMAGEPROC, GetTextureImage)                           \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                                   \
  F(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                               \
  F(PFNGLMULTIDRAWARRAYSINDIRECTPROC, MultiDrawArraysIndirect)           \
  F(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, MultiDrawElementsIndirect)       \
  F(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                     \
  F(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                     \
  F(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers)   \
  F(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)           \
  F(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, NamedFramebufferTextureLayer) \
  F(PFNGLOBJECTLABELPROC, ObjectLabel)                                   \
  F(PFNGLPIXELSTOREIPROC, PixelStorei)                                   \
  F(PFNGLPOPDEBUGGROUPPROC, PopDebugGroup)                               \
  F(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                         \
  F(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                         \
  F(PFNGLPUSHDEBUGGROUPPROC, PushDebugGroup)                             \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                                 \
  F(PFNGLTEXTUREBARRIERPROC, TextureBarrier)                             \
  F(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                               \
  F(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                       \
  F(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                         \
  F(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                         \
  F(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                       \
  F(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                       \
  F(PFNGLUSEPROGRAMPROC, UseProgram)                                     \
  F(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)         \
  F(PFNGLVERTEXARRAYATTRIBIFORMATPROC, VertexArrayAttribIFormat)         \
  F(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)       \
  F(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)         \
  F(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)           \
  F(PFNGLVIEWPORTPROC, Viewport)

/// The functions of one context. Passed by reference; valid as long as the context is current.
struct Gl {
#define RELIEF_GL_MEMBER(type, name) type name = nullptr;
  RELIEF_GL_FUNCTIONS(RELIEF_GL_MEMBER)
#undef RELIEF_GL_MEMBER
};

/// Loads the functions of the current context. Fails if it is older than OpenGL 4.5.
Result<Gl> load_functions(const GlContext& context);

/// One integer limit of the context.
[[nodiscard]] GLint get_limit(const Gl& gl, GLenum name);

/// Whether OpenGL has reported an error since the last call, as one sentence about `job` ("the
/// patch store"). Running out of memory is the only one a user should ever see.
Status check_errors(const Gl& gl, const char* job);

}  // namespace relief
