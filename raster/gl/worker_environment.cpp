// Variables: Mesa's documentation, "Environment Variables" (docs.mesa3d.org/envvars.html), release 22.3.
#include "raster/gl/worker_environment.h"

#include <unistd.h>

#include <algorithm>

#include "base/parallel.h"
#include "raster/gl/worker_process.h"

namespace twinshade::gl {
namespace {

// A user's settings for other programs must not change what is compared here. Our own (TWINSHADE_*) pass.
bool steers_drivers(const std::string& variable) {
  for (const char* prefix : {"GALLIUM_", "LP_", "MESA_", "LIBGL_", "EGL_", "GALLIVM_", "ST_", "DRAW_", "SOFTPIPE_",
                             "__EGL_", "__GLX_", "__GL_", "DISPLAY=", "WAYLAND_DISPLAY=", "NIR_"})
    if (variable.rfind(prefix, 0) == 0) return true;
  return false;
}

std::string name_of(const std::string& variable) { return variable.substr(0, variable.find('=')); }

}  // namespace

std::vector<std::pair<std::string, std::string>> worker_settings(GlBackend backend, const GlEnvironment& environment) {
  const int threads = environment.threads > 0 ? environment.threads : thread_count();
  std::vector<std::pair<std::string, std::string>> settings = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
  const bool software = backend != GlBackend::gpu;
  if (software) {
    settings.emplace_back("LIBGL_ALWAYS_SOFTWARE", "1");
    settings.emplace_back("GALLIUM_DRIVER", backend == GlBackend::softpipe ? "softpipe" : "llvmpipe");
    settings.emplace_back("LP_NUM_THREADS", std::to_string(threads));
    if (backend != GlBackend::osmesa) settings.emplace_back("EGL_PLATFORM", "surfaceless");
  }
  if (software && !environment.host_fma) settings.emplace_back("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1");
  for (const auto& extra : environment.extra) {
    std::erase_if(settings, [&](const auto& setting) { return setting.first == extra.first; });
    settings.push_back(extra);
  }
  return settings;
}

std::vector<std::string> worker_environment(GlBackend backend, const GlEnvironment& environment) {
  const auto settings = worker_settings(backend, environment);
  std::vector<std::string> result;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const std::string name = name_of(text);
    const bool replaced = std::any_of(settings.begin(), settings.end(), [&](const auto& s) { return s.first == name; });
    // Which vendors' drivers there are is the machine's business where a card is asked for.
    const bool card = backend == GlBackend::gpu && name.rfind("__EGL_VENDOR_LIBRARY_", 0) == 0;
    if ((card || !steers_drivers(text)) && !replaced && name != "ASAN_OPTIONS") result.push_back(text);
  }
  for (const auto& [name, value] : settings) result.push_back(name + "=" + value);
  // Under the address sanitizer a driver's crash must still be a signal, and its leaks are not ours.
  result.push_back(
      "ASAN_OPTIONS=detect_leaks=0:handle_segv=0:handle_abort=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0");
  result.push_back(std::string(kInsideWorker) + "=1");
  return result;
}

}  // namespace twinshade::gl
