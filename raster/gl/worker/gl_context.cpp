// Khronos: EGL 1.5; EGL_MESA_platform_surfaceless; EGL_EXT_platform_device; EGL_EXT_device_enumeration;
// EGL_KHR_no_config_context. Mesa: include/GL/osmesa.h.
#include "raster/gl/worker/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace twinshade::gl {
namespace {

class Library {
 public:
  Library(const char* variable, const char* usual) {
    const char* chosen = std::getenv(variable);
    name_ = chosen != nullptr ? chosen : usual;
    handle_ = dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) throw std::runtime_error("cannot load " + name_ + ": " + dlerror());
  }
  template <class Function>
  Function* get(const char* symbol) const {
    void* address = dlsym(handle_, symbol);
    if (address == nullptr) throw std::runtime_error(name_ + " has no " + symbol);
    return reinterpret_cast<Function*>(address);
  }

 private:
  std::string name_;
  void* handle_ = nullptr;  // stays open: Mesa leaves threads behind
};

class EglContext final : public GlContext {
 public:
  explicit EglContext(GlBackend backend) : library_("TWINSHADE_EGL_LIBRARY", "libEGL.so.1") {
    const bool full_version = backend != GlBackend::softpipe;
    const EGLDisplay display = backend == GlBackend::gpu ? card_display() : surfaceless_display();
    if (!library_.get<decltype(eglInitialize)>("eglInitialize")(display, nullptr, nullptr))
      fail("eglInitialize failed");
    if (!library_.get<decltype(eglBindAPI)>("eglBindAPI")(EGL_OPENGL_API)) fail("EGL has no desktop OpenGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 full_version ? 4 : 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 full_version ? 5 : 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    const EGLContext context = library_.get<decltype(eglCreateContext)>("eglCreateContext")(display, EGL_NO_CONFIG_KHR,
                                                                                            EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) fail(full_version ? "no OpenGL 4.5 core context" : "no OpenGL 3.3 core context");
    if (!library_.get<decltype(eglMakeCurrent)>("eglMakeCurrent")(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
      fail("eglMakeCurrent without a surface failed");
    load(library_.get<decltype(eglGetProcAddress)>("eglGetProcAddress"));
  }

 private:
  // An extension's function: null where EGL does not know it.
  template <class Function>
  Function extension(const char* name) const {
    return reinterpret_cast<Function>(library_.get<decltype(eglGetProcAddress)>("eglGetProcAddress")(name));
  }

  EGLDisplay platform_display(EGLenum platform, void* native) const {
    const auto get_display = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr) throw std::runtime_error("EGL has no platform displays (EGL_EXT_platform_base)");
    return get_display(platform, native, nullptr);
  }

  EGLDisplay surfaceless_display() const {
    const EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY) fail("no surfaceless display (EGL_MESA_platform_surfaceless)");
    return display;
  }

  // The first device that is not Mesa's processor, or the one that TWINSHADE_GPU numbers.
  EGLDisplay card_display() const {
    const auto query = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto describe = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (query == nullptr || describe == nullptr)
      throw std::runtime_error("EGL does not list devices (EGL_EXT_device_enumeration)");
    EGLDeviceEXT devices[64];
    EGLint count = 0;
    if (!query(64, devices, &count)) fail("eglQueryDevicesEXT failed");
    const char* wanted = std::getenv("TWINSHADE_GPU");
    EGLint chosen = -1;
    for (EGLint i = 0; i < count && chosen < 0; ++i) {
      const char* extensions = describe(devices[i], EGL_EXTENSIONS);
      const bool software = extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
      if (wanted != nullptr ? std::to_string(i) == wanted : !software) chosen = i;
    }
    const std::string among = "among the " + std::to_string(count) + " devices of EGL";
    if (chosen < 0 && wanted != nullptr)
      throw std::runtime_error("TWINSHADE_GPU=" + std::string(wanted) + " is none " + among + ", counted from 0");
    if (chosen < 0)
      throw std::runtime_error("no graphics card " + among + ": its driver's EGL library is not installed");
    const EGLDisplay display = platform_display(EGL_PLATFORM_DEVICE_EXT, devices[chosen]);
    if (display == EGL_NO_DISPLAY) fail("no display on the graphics card (EGL_EXT_platform_device)");
    return display;
  }

  [[noreturn]] void fail(const std::string& what) const {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", unsigned(library_.get<decltype(eglGetError)>("eglGetError")()));
    throw std::runtime_error(what + " (EGL error " + code + ")");
  }
  Library library_;
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() : library_("TWINSHADE_OSMESA_LIBRARY", "libOSMesa.so.8") {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    const OSMesaContext context =
        library_.get<decltype(OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs")(attributes, nullptr);
    if (context == nullptr) throw std::runtime_error("OSMesa has no OpenGL 4.5 core context");
    // OSMesa wants a surface; everything is drawn to framebuffer objects.
    if (!library_.get<decltype(OSMesaMakeCurrent)>("OSMesaMakeCurrent")(context, surface_.data(), GL_UNSIGNED_BYTE, 4,
                                                                        4))
      throw std::runtime_error("OSMesaMakeCurrent failed");
    load(library_.get<decltype(OSMesaGetProcAddress)>("OSMesaGetProcAddress"));
  }

 private:
  Library library_;
  std::array<unsigned char, 4 * 4 * 4> surface_{};
};

}  // namespace

void GlContext::load(Procedure (*get)(const char*)) {
#define TWINSHADE_GL_LOAD(name, TYPE)                                     \
  functions_.name = reinterpret_cast<PFNGL##TYPE##PROC>(get("gl" #name)); \
  if (functions_.name == nullptr) throw std::runtime_error("the driver has no gl" #name);
  TWINSHADE_GL_FUNCTIONS(TWINSHADE_GL_LOAD)
#undef TWINSHADE_GL_LOAD
}

std::vector<std::pair<std::string, std::string>> GlContext::provenance() const {
  const auto text = [&](GLenum name) {
    const GLubyte* value = functions_.GetString(name);
    return std::string(value == nullptr ? "" : reinterpret_cast<const char*>(value));
  };
  return {{"GL_RENDERER", text(GL_RENDERER)},
          {"GL_VERSION", text(GL_VERSION)},
          {"GL_VENDOR", text(GL_VENDOR)},
          {"GL_SHADING_LANGUAGE_VERSION", text(GL_SHADING_LANGUAGE_VERSION)}};
}

std::unique_ptr<GlContext> make_context(GlBackend backend) {
  if (backend == GlBackend::osmesa) return std::make_unique<OsMesaContext>();
  return std::make_unique<EglContext>(backend);
}

void check_errors(const GlFunctions& gl, const std::string& what) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  const char* name = error == GL_INVALID_ENUM                    ? "GL_INVALID_ENUM"
                     : error == GL_INVALID_VALUE                 ? "GL_INVALID_VALUE"
                     : error == GL_INVALID_OPERATION             ? "GL_INVALID_OPERATION"
                     : error == GL_OUT_OF_MEMORY                 ? "GL_OUT_OF_MEMORY"
                     : error == GL_INVALID_FRAMEBUFFER_OPERATION ? "GL_INVALID_FRAMEBUFFER_OPERATION"
                                                                 : "an unknown error";
  while (gl.GetError() != GL_NO_ERROR) {
  }
  throw std::runtime_error(std::string(name) + " while " + what);
}

}  // namespace twinshade::gl
