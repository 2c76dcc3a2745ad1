// OpenGL's entry points, fetched from the context's own library.
#pragma once

#include <GL/glcorearb.h>

#include <string>

namespace twinshade::gl {

// X(name without "gl", type in upper case as in PFNGL...PROC)
#define TWINSHADE_GL_FUNCTIONS(X)                         \
  X(ActiveTexture, ACTIVETEXTURE)                         \
  X(AttachShader, ATTACHSHADER)                           \
  X(BindBuffer, BINDBUFFER)                               \
  X(BindBufferBase, BINDBUFFERBASE)                       \
  X(BindFramebuffer, BINDFRAMEBUFFER)                     \
  X(BindTexture, BINDTEXTURE)                             \
  X(BindVertexArray, BINDVERTEXARRAY)                     \
  X(BufferData, BUFFERDATA)                               \
  X(BufferSubData, BUFFERSUBDATA)                         \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)       \
  X(ClearBufferfv, CLEARBUFFERFV)                         \
  X(ClearBufferuiv, CLEARBUFFERUIV)                       \
  X(ColorMask, COLORMASK)                                 \
  X(CompileShader, COMPILESHADER)                         \
  X(CreateProgram, CREATEPROGRAM)                         \
  X(CreateShader, CREATESHADER)                           \
  X(CullFace, CULLFACE)                                   \
  X(DeleteBuffers, DELETEBUFFERS)                         \
  X(DeleteFramebuffers, DELETEFRAMEBUFFERS)               \
  X(DeleteProgram, DELETEPROGRAM)                         \
  X(DeleteShader, DELETESHADER)                           \
  X(DeleteTextures, DELETETEXTURES)                       \
  X(DepthFunc, DEPTHFUNC)                                 \
  X(DepthMask, DEPTHMASK)                                 \
  X(Disable, DISABLE)                                     \
  X(DisableVertexAttribArray, DISABLEVERTEXATTRIBARRAY)   \
  X(DispatchCompute, DISPATCHCOMPUTE)                     \
  X(DrawArrays, DRAWARRAYS)                               \
  X(DrawBuffers, DRAWBUFFERS)                             \
  X(DrawElements, DRAWELEMENTS)                           \
  X(Enable, ENABLE)                                       \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)     \
  X(Finish, FINISH)                                       \
  X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)           \
  X(GenBuffers, GENBUFFERS)                               \
  X(GenFramebuffers, GENFRAMEBUFFERS)                     \
  X(GenTextures, GENTEXTURES)                             \
  X(GenVertexArrays, GENVERTEXARRAYS)                     \
  X(GetActiveUniform, GETACTIVEUNIFORM)                   \
  X(GetActiveUniformBlockName, GETACTIVEUNIFORMBLOCKNAME) \
  X(GetActiveUniformBlockiv, GETACTIVEUNIFORMBLOCKIV)     \
  X(GetBufferSubData, GETBUFFERSUBDATA)                   \
  X(GetError, GETERROR)                                   \
  X(GetIntegerv, GETINTEGERV)                             \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)                 \
  X(GetProgramInterfaceiv, GETPROGRAMINTERFACEIV)         \
  X(GetProgramResourceName, GETPROGRAMRESOURCENAME)       \
  X(GetProgramResourceiv, GETPROGRAMRESOURCEIV)           \
  X(GetProgramiv, GETPROGRAMIV)                           \
  X(GetShaderInfoLog, GETSHADERINFOLOG)                   \
  X(GetShaderiv, GETSHADERIV)                             \
  X(GetString, GETSTRING)                                 \
  X(GetUniformLocation, GETUNIFORMLOCATION)               \
  X(LinkProgram, LINKPROGRAM)                             \
  X(MemoryBarrier, MEMORYBARRIER)                         \
  X(PixelStorei, PIXELSTOREI)                             \
  X(ReadBuffer, READBUFFER)                               \
  X(ReadPixels, READPIXELS)                               \
  X(ShaderSource, SHADERSOURCE)                           \
  X(ShaderStorageBlockBinding, SHADERSTORAGEBLOCKBINDING) \
  X(TexBuffer, TEXBUFFER)                                 \
  X(TexImage2D, TEXIMAGE2D)                               \
  X(TexImage3D, TEXIMAGE3D)                               \
  X(TexParameteri, TEXPARAMETERI)                         \
  X(Uniform1fv, UNIFORM1FV)                               \
  X(Uniform1i, UNIFORM1I)                                 \
  X(Uniform1iv, UNIFORM1IV)                               \
  X(Uniform1uiv, UNIFORM1UIV)                             \
  X(Uniform2f, UNIFORM2F)                                 \
  X(Uniform2fv, UNIFORM2FV)                               \
  X(Uniform2iv, UNIFORM2IV)                               \
  X(Uniform2uiv, UNIFORM2UIV)                             \
  X(Uniform3fv, UNIFORM3FV)                               \
  X(Uniform3iv, UNIFORM3IV)                               \
  X(Uniform3uiv, UNIFORM3UIV)                             \
  X(Uniform4fv, UNIFORM4FV)                               \
  X(Uniform4iv, UNIFORM4IV)                               \
  X(Uniform4uiv, UNIFORM4UIV)                             \
  X(UniformBlockBinding, UNIFORMBLOCKBINDING)             \
  X(UniformMatrix2fv, UNIFORMMATRIX2FV)                   \
  X(UniformMatrix2x3fv, UNIFORMMATRIX2X3FV)               \
  X(UniformMatrix2x4fv, UNIFORMMATRIX2X4FV)               \
  X(UniformMatrix3fv, UNIFORMMATRIX3FV)                   \
  X(UniformMatrix3x2fv, UNIFORMMATRIX3X2FV)               \
  X(UniformMatrix3x4fv, UNIFORMMATRIX3X4FV)               \
  X(UniformMatrix4fv, UNIFORMMATRIX4FV)                   \
  X(UniformMatrix4x2fv, UNIFORMMATRIX4X2FV)               \
  X(UniformMatrix4x3fv, UNIFORMMATRIX4X3FV)               \
  X(UseProgram, USEPROGRAM)                               \
  X(VertexAttribIPointer, VERTEXATTRIBIPOINTER)           \
  X(VertexAttribPointer, VERTEXATTRIBPOINTER)             \
  X(Viewport, VIEWPORT)

struct GlFunctions {
#define TWINSHADE_GL_MEMBER(name, TYPE) PFNGL##TYPE##PROC name = nullptr;
  TWINSHADE_GL_FUNCTIONS(TWINSHADE_GL_MEMBER)
#undef TWINSHADE_GL_MEMBER
};

// std::runtime_error naming the first error since the last call and `what` was being done.
void check_errors(const GlFunctions& gl, const std::string& what);

}  // namespace twinshade::gl
