// The OpenGL functions that the backend calls, by their names without "gl". Loaded through EGL, so that nothing is
// linked and a machine without OpenGL can still list the plugin.
#pragma once

#include <GL/glcorearb.h>

#include <string>

namespace dvrlab {

#define DVRLAB_GL_FUNCTIONS(X)                             \
  X(PFNGLATTACHSHADERPROC, AttachShader)                   \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)               \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                 \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                 \
  X(PFNGLCREATEQUERIESPROC, CreateQueries)                 \
  X(PFNGLCREATESHADERPROC, CreateShader)                   \
  X(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)   \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                 \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                 \
  X(PFNGLDELETEQUERIESPROC, DeleteQueries)                 \
  X(PFNGLDELETESHADERPROC, DeleteShader)                   \
  X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)             \
  X(PFNGLENABLEPROC, Enable)                               \
  X(PFNGLFINISHPROC, Finish)                               \
  X(PFNGLGETERRORPROC, GetError)                           \
  X(PFNGLGETINTEGER64VPROC, GetInteger64v)                 \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                     \
  X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData) \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)         \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                   \
  X(PFNGLGETQUERYIVPROC, GetQueryiv)                       \
  X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)     \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)           \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                     \
  X(PFNGLGETSTRINGPROC, GetString)                         \
  X(PFNGLGETSTRINGIPROC, GetStringi)                       \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                     \
  X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                 \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)       \
  X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)       \
  X(PFNGLQUERYCOUNTERPROC, QueryCounter)                   \
  X(PFNGLSHADERBINARYPROC, ShaderBinary)                   \
  X(PFNGLSPECIALIZESHADERARBPROC, SpecializeShaderARB)     \
  X(PFNGLUSEPROGRAMPROC, UseProgram)

struct GlFunctions {
#define DVRLAB_GL_MEMBER(type, name) type name = nullptr;
  DVRLAB_GL_FUNCTIONS(DVRLAB_GL_MEMBER)
#undef DVRLAB_GL_MEMBER

  /// `address` maps a name to the function or nullptr. Returns the first name that is missing, "" when all are there.
  template <class Address>
  std::string load(Address address) {
#define DVRLAB_GL_LOAD(type, name)                    \
  name = reinterpret_cast<type>(address("gl" #name)); \
  if (name == nullptr) return "gl" #name;
    DVRLAB_GL_FUNCTIONS(DVRLAB_GL_LOAD)
#undef DVRLAB_GL_LOAD
    return "";
  }
  bool has_extension(const std::string& wanted) const {
    GLint count = 0;
    GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint e = 0; e < count; ++e)
      if (wanted == reinterpret_cast<const char*>(GetStringi(GL_EXTENSIONS, GLuint(e)))) return true;
    return false;
  }
  std::string text(GLenum name) const { return reinterpret_cast<const char*>(GetString(name)); }
};

}  // namespace dvrlab
