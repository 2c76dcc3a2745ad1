// The renderers by name, made when first needed.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/options.h"
#include "evaluate/evaluator.h"
#include "raster/renderer.h"

namespace twinshade {

// "cpu", "egl", "osmesa", "softpipe", "gpu": those that --on takes.
const std::vector<std::string>& backend_names();
// UserError with the nearest names where one is unknown or named twice.
void require_backends(const std::vector<std::string>& names);

// One of those; another name is a broken invariant.
Backend backend_named(const std::string& name);

// What a frame's colour may be (DrawOptions::output).
struct FrameOutput {
  std::string name;  // "color", "targets[1]"
  std::uint32_t location = 0;
};

class Machines {
 public:
  // host_fma: false runs OpenGL on the processor's capabilities without fused multiply-add.
  Machines(const CpuOptions& cpu, bool host_fma) : cpu_(cpu), host_fma_(host_fma) {}

  // cpu_frame: softpipe only, the CPU's frame with captured attributes.
  Frame draw(const std::string& backend, const Bundle& bundle, const ShaderSource& source, DrawOptions options,
             const Frame* cpu_frame = nullptr);
  bool uses_derivatives(const ShaderSource& source) const;
  std::vector<FrameOutput> outputs(const ShaderSource& source) const;  // by location

 private:
  Number number() const;
  Renderer& renderer(const std::string& backend);

  CpuOptions cpu_;
  bool host_fma_;
  std::map<std::string, std::unique_ptr<Renderer>> renderers_;
};

// The widest number type that shading has for an instruction set: what is drawn with unless the user says otherwise.
Number natural_number(Isa isa);

}  // namespace twinshade
