// The Renderer over a worker: checks the shader's inputs against the bundle, generates programs, sends, receives.
#include "raster/gl/gl_renderer.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "raster/gl/bundle_image.h"
#include "raster/gl/fragment_rewrite.h"
#include "raster/gl/generated_shaders.h"
#include "raster/gl/worker_process.h"

namespace twinshade {
namespace gl {
namespace {

std::string attribute_names(const Bundle& bundle) {
  std::string names;
  for (const Attribute& attribute : bundle.attributes) names += (names.empty() ? "" : ", ") + attribute.name;
  return names.empty() ? "none" : names;
}

std::string leaf_type(Scalar scalar, std::uint32_t components) {
  const std::string prefix = scalar == Scalar::i32 ? "i" : scalar == Scalar::u32 ? "u" : "";
  if (components > 1) return prefix + "vec" + std::to_string(components);
  return scalar == Scalar::f32 ? "float" : prefix + (scalar == Scalar::u32 ? "int" : "nt");
}

// Inputs that the bundle supplies. What is declared but never used may be missing.
std::vector<Input> supplied_inputs(const Bundle& bundle, const ShaderSource& source, const std::vector<Input>& inputs) {
  std::vector<Input> supplied;
  for (const Input& input : inputs) {
    bool complete = true;
    for (const InputLeaf& leaf : leaves_of({input})) {
      const Attribute* attribute = bundle.find_attribute(leaf.name);
      complete = complete && attribute != nullptr;
      if (!input.used) continue;
      const std::string what =
          position(source, input.where) + "input " + leaf.name + " (" + leaf_type(leaf.scalar, leaf.components) + ")";
      if (attribute == nullptr) throw UserError(what + " is not in the bundle, which has: " + attribute_names(bundle));
      if (attribute->scalar != leaf.scalar || attribute->components != leaf.components)
        throw UserError(what + " is " + leaf_type(attribute->scalar, attribute->components) + " in the bundle");
    }
    if (complete) supplied.push_back(input);
  }
  return supplied;
}

// The first line of a driver's log that reports an error, with the author's file and line.
std::string first_error(const ShaderSource& source, const std::string& log) {
  std::istringstream lines(map_driver_log(source, log));
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error") != std::string::npos) return line;
    if (first.empty()) first = line;
  }
  return first;
}

bool about_generated_lines(const std::string& error) {
  return error.rfind(std::to_string(kGeneratedFile) + ":", 0) == 0;
}

}  // namespace

class GlRenderer final : public Renderer {
 public:
  GlRenderer(GlBackend backend, GlEnvironment environment)
      : backend_(backend), worker_(backend, std::move(environment)) {}

  std::string name() const override { return backend_name(backend_); }

  Frame draw(const Bundle& bundle, const ShaderSource& source, const DrawOptions& options) override {
    if (backend_ == GlBackend::softpipe)
      throw BackendError(
          "softpipe: its coverage is not comparable (4 subpixel bits): it shades what the CPU covered, see "
          "shade_on_softpipe");
    validate(bundle, "bundle");
    const bool exact = options.attributes == AttributeMode::exact;
    const FragmentShader shader = rewrite_fragment_shader(source, exact ? InputStyle::globals : InputStyle::varyings);
    const ShaderGenerator generator(source, shader, supplied_inputs(bundle, source, shader.inputs),
                                    exact ? Supply::exact : Supply::varyings);
    DrawRequest request = basic_request(bundle, generator, options.time_limit_seconds);
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
    if (options.capture_attributes) {
      frame.attribute_names = names;
      copy_out(frame_layout(pixels(bundle), request.components, false).attributes, pixels(bundle) * names.size(),
               frame.attributes);
    }
    frame.provenance.emplace_back("attributes", exact ? "exact" : "native");
    return frame;
  }

  Frame shade(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame, double time_limit_seconds) {
    validate(bundle, "bundle");
    const FragmentShader shader = rewrite_fragment_shader(source, InputStyle::globals);
    if (!shader.derivative.empty())
      throw UserError(shader.derivative +
                      " cannot be shaded on softpipe: pixels are drawn there without their primitive's neighbours");
    const ShaderGenerator generator(source, shader, supplied_inputs(bundle, source, shader.inputs), Supply::texels);
    DrawRequest request = basic_request(bundle, generator, time_limit_seconds);
    const std::vector<std::string> names = generator.component_names();
    request.components = std::uint32_t(names.size());
    return exchange(bundle, source, request, &cpu_frame, names);
  }

 private:
  static std::size_t pixels(const Bundle& bundle) { return std::size_t(bundle.width) * bundle.height; }

  static DrawRequest basic_request(const Bundle& bundle, const ShaderGenerator& generator, double time_limit_seconds) {
    DrawRequest request;
    request.width = bundle.width, request.height = bundle.height;
    request.cull_back_faces = bundle.cull_back_faces;
    request.geometry = generator.geometry();
    request.leaves = generator.leaves();
    request.frame = generator.frame();
    request.time_limit_seconds = time_limit_seconds;
    for (const Uniform& u : bundle.uniforms)
      request.uniforms.push_back({u.name, u.scalar, u.columns, u.rows, u.array_length, u.values});
    return request;
  }

  // One round trip. A worker that has died is started again, and gets everything again.
  Frame exchange(const Bundle& bundle, const ShaderSource& source, DrawRequest& request, const Frame* cpu_frame,
                 const std::vector<std::string>& cpu_names = {}) {
    if (!worker_.running()) {
      image_.forget();
      shared_frame_ = SharedMemory();
      worker_.start(request.time_limit_seconds);
    }
    std::vector<int> descriptors;
    try {
      request.new_image = image_.update(bundle);
      if (request.new_image) {
        request.image = image_.index();
        descriptors.push_back(image_.fd());
      }
      const FrameLayout layout = frame_layout(pixels(bundle), request.components, cpu_frame != nullptr);
      if (shared_frame_.size() < layout.size) {
        shared_frame_ = SharedMemory::create(layout.size);
        descriptors.push_back(shared_frame_.fd());
      }
      if (cpu_frame != nullptr) put_cpu_pixels(*cpu_frame, cpu_names, layout);
    } catch (const std::system_error& error) {
      worker_.stop();
      throw BackendError(name() + ": " + error.what());
    }

    WireWriter writer;
    writer.put(request);
    DrawReply reply;
    const std::string answer = worker_.exchange(writer.take(), descriptors, request.time_limit_seconds);
    WireReader(answer).get(reply);
    if (reply.outcome != Outcome::ok) fail(source, reply);
    return frame_of(bundle, reply, cpu_frame);
  }

  [[noreturn]] void fail(const ShaderSource& source, const DrawReply& reply) {
    const std::string file = source.files.empty() ? source.name : source.files[0];
    if (reply.outcome == Outcome::user_error) throw UserError(file + ": " + reply.text);
    if (reply.outcome == Outcome::glsl_error) {
      const std::string error = first_error(source, reply.text);
      if (about_generated_lines(error)) throw BackendError(name() + ": the driver rejects generated GLSL: " + error);
      throw UserError(error + " (" + name() + ")");
    }
    worker_.stop();  // after a failed driver call nothing is known about its state
    throw BackendError(name() + ": " + reply.text);
  }

  void put_cpu_pixels(const Frame& cpu, const std::vector<std::string>& names, const FrameLayout& layout) {
    const std::size_t count = std::size_t(cpu.width) * cpu.height;
    auto* ids = reinterpret_cast<std::uint32_t*>(shared_frame_.data() + layout.cpu_id);
    for (std::size_t p = 0; p < count; ++p) ids[p] = cpu.coverage[p] ? cpu.primitive_id[p] : kNoPrimitive;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = std::find(cpu.attribute_names.begin(), cpu.attribute_names.end(), names[i]);
      if (found == cpu.attribute_names.end())
        throw UserError("softpipe: the frame to shade has no captured attribute " + names[i]);
      const auto plane = std::size_t(found - cpu.attribute_names.begin());
      std::memcpy(shared_frame_.data() + layout.cpu_attributes + i * count * 4, cpu.attributes.data() + plane * count,
                  count * 4);
    }
  }

  template <class T>
  void copy_out(std::uint64_t offset, std::size_t count, std::vector<T>& to) const {
    to.resize(count);
    if (count != 0) std::memcpy(to.data(), shared_frame_.data() + offset, count * sizeof(T));
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
    for (const auto& setting : worker_.settings()) frame.provenance.push_back(setting);
    return frame;
  }

  const GlBackend backend_;
  WorkerProcess worker_;
  BundleImage image_;
  SharedMemory shared_frame_;
};

}  // namespace gl

std::unique_ptr<Renderer> make_gl_renderer(GlBackend backend, const GlEnvironment& environment) {
  return std::make_unique<gl::GlRenderer>(backend, environment);
}

Frame shade_on_softpipe(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame,
                        const GlEnvironment& environment, double time_limit_seconds) {
  if (cpu_frame.width != bundle.width || cpu_frame.height != bundle.height)
    throw UserError("softpipe: the frame to shade has another size than the bundle");
  return gl::GlRenderer(GlBackend::softpipe, environment).shade(bundle, source, cpu_frame, time_limit_seconds);
}

}  // namespace twinshade
