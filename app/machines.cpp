#include "app/machines.h"

#include <algorithm>

#include "app/memory_needed.h"
#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/translate/source_lines.h"
#include "raster/tiled/tiled_renderer.h"
#if TWINSHADE_HAS_GL
#include "raster/gl/gl_renderer.h"
#endif

namespace twinshade {
namespace {

#if TWINSHADE_HAS_GL
GlEnvironment gl_environment(bool host_fma) {
  GlEnvironment environment;
  environment.threads = thread_count();
  environment.host_fma = host_fma;
  return environment;
}

std::unique_ptr<Renderer> make_gl(const std::string& backend, bool host_fma) {
  GlEnvironment environment = gl_environment(host_fma);
  environment.written_out = backend == "gpu";
  const GlBackend gl = backend == "gpu" ? GlBackend::gpu : backend == "egl" ? GlBackend::egl : GlBackend::osmesa;
  return make_gl_renderer(gl, environment);
}

Frame shade_gl(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame, bool host_fma,
               const DrawOptions& options) {
  return shade_on_softpipe(bundle, source, cpu_frame, gl_environment(host_fma), options.time_limit_seconds,
                           options.output);
}
#else
[[noreturn]] void refuse(const std::string& backend) {
  throw BackendError(backend + ": this build has no OpenGL backends (TWINSHADE_GL=OFF)");
}

std::unique_ptr<Renderer> make_gl(const std::string& backend, bool) { refuse(backend); }
Frame shade_gl(const Bundle&, const ShaderSource&, const Frame&, bool, const DrawOptions&) { refuse("softpipe"); }
#endif

ShaderSource of_precision(ShaderSource source, Precision precision) {
  source.precision = precision;
  return source;
}

}  // namespace

const std::vector<std::string>& backend_names() {
  static const std::vector<std::string> names{"cpu", "egl", "osmesa", "softpipe", "gpu"};
  return names;
}

void require_backends(const std::vector<std::string>& names) {
  const auto& known = backend_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(known.begin(), known.end(), names[i]) == known.end())
      throw UserError(unknown_name_message("backend", names[i], known));
    if (std::find(names.begin(), names.begin() + std::ptrdiff_t(i), names[i]) != names.begin() + std::ptrdiff_t(i))
      throw UserError("--on: " + names[i] + " is named twice");
  }
}

Backend backend_named(const std::string& name) {
  const auto found = std::find_if(std::begin(kBackends), std::end(kBackends),
                                  [&](const Backend backend) { return name == backend_name(backend); });
  TWINSHADE_CHECK_EQ(found != std::end(kBackends), true);
  return *found;
}

Frame Machines::draw(const std::string& backend, const Bundle& bundle, const ShaderSource& source, DrawOptions options,
                     const Frame* cpu_frame) {
  options.tile_size = cpu_.tile_size;
  options.isa = cpu_.isa;
  options.number = number();
  if (backend == "softpipe") {
    TWINSHADE_CHECK_EQ(cpu_frame != nullptr, true);
    return shade_gl(bundle, source, *cpu_frame, host_fma_, options);
  }
  require_frame_memory(bundle.width, bundle.height, backend);
  try {
    Frame frame = renderer(backend).draw(bundle, of_precision(source, cpu_.precision), options);
    if (backend == "cpu" && cpu_.precision != Precision::full)
      frame.provenance.emplace_back("precision", precision_names()[cpu_.precision == Precision::half]);
    return frame;
  } catch (const UnboundError& error) {
    const std::string whole = error.variable.substr(0, error.variable.find_first_of(".["));  // of "light.colour"
    const bool texture = error.reason.starts_with("texture ");
    throw UserError(SourceLines(source).declaration(whole).text() + ": " + error.reason +
                    (texture ? "; a sampler2D of your own gets a picture by --texture " + whole + "=FILE" : ""));
  }
}

std::vector<FrameOutput> Machines::outputs(const ShaderSource& source) const {
  const ShaderModule& module = load_module(of_precision(source, cpu_.precision), number(), cpu_.isa);
  std::vector<FrameOutput> list;
  for (std::uint32_t i = 0; i < module.output_count; ++i) {
    const ShaderVariable& output = module.outputs[i];
    for (std::uint32_t element = 0; element < std::max(1u, output.array_length); ++element)
      list.push_back({output.name + (output.array_length > 0 ? "[" + std::to_string(element) + "]" : std::string()),
                      std::uint32_t(std::max(0, output.location)) + element});
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.location < b.location; });
  return list;
}

bool Machines::uses_derivatives(const ShaderSource& source) const {
  return load_module(of_precision(source, cpu_.precision), number(), cpu_.isa).uses_derivatives;
}

Number Machines::number() const { return cpu_.number.value_or(natural_number(cpu_.isa.value_or(machine_isa()))); }

Renderer& Machines::renderer(const std::string& backend) {
  std::unique_ptr<Renderer>& made = renderers_[backend];
  if (!made) made = backend == "cpu" ? make_tiled_renderer(load_module) : make_gl(backend, host_fma_);
  return *made;
}

Number natural_number(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return Number::lanes16;
    case Isa::avx2:
      return Number::lanes8;
    case Isa::baseline:
      return Number::lanes4;
  }
  return Number::lanes4;
}

}  // namespace twinshade
