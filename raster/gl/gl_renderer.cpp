// The Renderer over a worker: checks the shader's inputs against the bundle, generates programs, sends, receives.
#include "raster/gl/gl_renderer.h"

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "raster/gl/gl_session.h"

namespace twinshade {
namespace gl {

class GlRenderer final : public Renderer {
 public:
  GlRenderer(GlBackend backend, GlEnvironment environment)
      : backend_(backend), session_(backend, std::move(environment)) {}

  std::string name() const override { return backend_name(backend_); }

  Frame draw(const Bundle& bundle, const ShaderSource& author, const DrawOptions& options) override {
    if (backend_ == GlBackend::softpipe)
      throw BackendError(
          "softpipe: its coverage is not comparable (4 subpixel bits): it shades what the CPU covered, see "
          "shade_on_softpipe");
    validate(bundle, "bundle");
    const bool exact = options.attributes == AttributeMode::exact, written_out = exact && session_.writes_out();
    const ShaderSource source = written_out ? make_exact(author, ExactScope::written_out).source : author;
    const FragmentShader shader = rewrite_fragment_shader(source, exact ? InputStyle::globals : InputStyle::varyings);
    ShaderGenerator generator(source, shader, supplied_inputs(bundle.attributes, source, shader.inputs),
                              exact ? Supply::exact : Supply::varyings, 450, written_out);
    generator.choose_output(options.output);
    DrawRequest request = basic_request(bundle, source, generator, options.time_limit_seconds);
    const std::vector<std::string> names = generator.component_names();
    if (options.capture_attributes) {
      request.components = std::uint32_t(names.size());
      for (std::uint32_t first = 0; first < request.components; first += 4 * kCaptureTargets)
        request.captures.push_back(generator.capture(first));
    }
    request.timing = options.repeat > 1 || options.warmup > 0 || options.depth_prepass;
    request.repeat = std::max(options.repeat, 1);
    request.warmup = std::max(options.warmup, 0);
    if (request.timing) request.timed = generator.timed();
    if (options.depth_prepass) {
      if (shader.discards || shader.writes_depth)
        throw UserError(source.name +
                        ": a depth prepass cannot be drawn for a shader that discards or writes gl_FragDepth");
      request.prepass_wanted = true;
      request.prepass = generator.prepass();
    }

    Frame frame = exchange(bundle, source, request, nullptr);
    frame.color_scalar = generator.color_scalar();
    if (options.capture_attributes) {
      frame.attribute_names = names;
      frame.attribute_scalars = generator.component_scalars();
      copy_out(frame_layout(pixels(bundle), request.components, false).attributes, pixels(bundle) * names.size(),
               frame.attributes);
    }
    frame.provenance.emplace_back("attributes", exact ? "exact" : "native");
    if (backend_ == GlBackend::gpu)
      frame.provenance.emplace_back("division", written_out ? "written out" : "the card's");
    return frame;
  }

  Frame shade(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame, std::uint32_t output,
              double time_limit_seconds) {
    validate(bundle, "bundle");
    const FragmentShader shader = rewrite_fragment_shader(source, InputStyle::globals);
    if (!shader.derivative.empty())
      throw UserError(shader.derivative +
                      " cannot be shaded on softpipe: pixels are drawn there without their primitive's neighbours");
    ShaderGenerator generator(source, shader, supplied_inputs(bundle.attributes, source, shader.inputs), Supply::texels,
                              330);
    generator.choose_output(output);
    DrawRequest request = basic_request(bundle, source, generator, time_limit_seconds);
    const std::vector<std::string> names = generator.component_names();
    request.components = std::uint32_t(names.size());
    Frame frame = exchange(bundle, source, request, &cpu_frame, names);
    frame.color_scalar = generator.color_scalar();
    return frame;
  }

  std::vector<Buffer> dispatch(const Bundle& bundle, const ShaderSource& source,
                               const std::array<std::uint32_t, 3>& groups, double time_limit_seconds) {
    DrawRequest request;
    const std::string version = "#version " + std::to_string(source.version) + (source.es ? " es\n" : "\n");
    request.frame.compute = gl_text(source, version, "layout(std140) uniform;\nlayout(std430) buffer;\n");
    std::copy(groups.begin(), groups.end(), request.groups);
    request.time_limit_seconds = time_limit_seconds;
    put_uniforms(bundle, source, request);
    std::size_t memory = 64;
    for (const Buffer& buffer : bundle.buffers)
      if (buffer.storage) memory += (buffer.bytes.size() + 63) / 64 * 64;
    session_.exchange(bundle, source, request, memory, [] {});
    std::vector<Buffer> result;
    const std::byte* from = session_.memory();
    for (const Buffer& buffer : bundle.buffers) {
      if (!buffer.storage) continue;
      result.push_back({buffer.name, true, {from, from + buffer.bytes.size()}});
      from += (buffer.bytes.size() + 63) / 64 * 64;
    }
    return result;
  }

 private:
  static std::size_t pixels(const Bundle& bundle) { return std::size_t(bundle.width) * bundle.height; }

  static DrawRequest basic_request(const Bundle& bundle, const ShaderSource& source, const ShaderGenerator& generator,
                                   double time_limit_seconds) {
    DrawRequest request = request_for(bundle, source, generator, time_limit_seconds);
    request.frame = generator.frame();
    return request;
  }

  Frame exchange(const Bundle& bundle, const ShaderSource& source, DrawRequest& request, const Frame* cpu_frame,
                 const std::vector<std::string>& cpu_names = {}) {
    const FrameLayout layout = frame_layout(pixels(bundle), request.components, cpu_frame != nullptr);
    DrawReply reply = session_.exchange(bundle, source, request, layout.size, [&] {
      if (cpu_frame != nullptr) put_cpu_pixels(*cpu_frame, cpu_names, layout);
    });
    return frame_of(bundle, reply, cpu_frame);
  }

  void put_cpu_pixels(const Frame& cpu, const std::vector<std::string>& names, const FrameLayout& layout) {
    const std::size_t count = std::size_t(cpu.width) * cpu.height;
    auto* ids = reinterpret_cast<std::uint32_t*>(session_.memory() + layout.cpu_id);
    for (std::size_t p = 0; p < count; ++p) ids[p] = cpu.coverage[p] ? cpu.primitive_id[p] : kNoPrimitive;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = std::find(cpu.attribute_names.begin(), cpu.attribute_names.end(), names[i]);
      if (found == cpu.attribute_names.end())
        throw UserError("softpipe: the frame to shade has no captured attribute " + names[i]);
      const auto plane = std::size_t(found - cpu.attribute_names.begin());
      std::memcpy(session_.memory() + layout.cpu_attributes + i * count * 4, cpu.attributes.data() + plane * count,
                  count * 4);
    }
  }

  template <class Vector>
  void copy_out(std::uint64_t offset, std::size_t count, Vector& to) const {
    to.resize(count);
    if (count != 0) std::memcpy(to.data(), session_.memory() + offset, count * sizeof to[0]);
  }

  Frame frame_of(const Bundle& bundle, DrawReply& reply, const Frame* cpu_frame) const {
    const std::size_t count = pixels(bundle);
    const FrameLayout layout = frame_layout(count, 0, false);  // the first parts lie the same in every layout
    Frame frame;
    frame.width = bundle.width, frame.height = bundle.height;
    copy_out(layout.color, count * 4, frame.color);
    copy_out(layout.id, count, frame.primitive_id);
    frame.coverage.resize(count);
    for (std::size_t p = 0; p < count; ++p) frame.coverage[p] = frame.primitive_id[p] != kNoPrimitive;
    if (cpu_frame == nullptr) {
      copy_out(layout.depth, count, frame.depth);
    } else {
      frame.depth.assign(count, 1.0f);
      for (std::size_t p = 0; p < count; ++p)
        if (frame.coverage[p]) frame.depth[p] = cpu_frame->depth[p];
    }
    frame.milliseconds = std::move(reply.milliseconds);
    frame.provenance = std::move(reply.provenance);
    frame.provenance.insert(frame.provenance.begin(), {"backend", name()});
    for (const auto& setting : session_.settings()) frame.provenance.push_back(setting);
    return frame;
  }

  const GlBackend backend_;
  GlSession session_;
};

}  // namespace gl

std::unique_ptr<Renderer> make_gl_renderer(GlBackend backend, const GlEnvironment& environment) {
  return std::make_unique<gl::GlRenderer>(backend, environment);
}

Frame shade_on_softpipe(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame,
                        const GlEnvironment& environment, double time_limit_seconds, std::uint32_t output) {
  if (cpu_frame.width != bundle.width || cpu_frame.height != bundle.height)
    throw UserError("softpipe: the frame to shade has another size than the bundle");
  return gl::GlRenderer(GlBackend::softpipe, environment).shade(bundle, source, cpu_frame, output, time_limit_seconds);
}

std::vector<Buffer> dispatch_on_gl(GlBackend backend, const Bundle& bundle, const ShaderSource& source,
                                   const std::array<std::uint32_t, 3>& groups, const GlEnvironment& environment,
                                   double time_limit_seconds) {
  return gl::GlRenderer(backend, environment).dispatch(bundle, source, groups, time_limit_seconds);
}

}  // namespace twinshade
