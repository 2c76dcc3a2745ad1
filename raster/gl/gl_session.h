// What renderers over a worker share: the worker, started when it is first needed and again where it died, what it has
// been sent, and the errors it answers with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "raster/gl/bundle_image.h"
#include "raster/gl/fragment_rewrite.h"
#include "raster/gl/generated_shaders.h"
#include "raster/gl/worker_process.h"

namespace twinshade::gl {

class GlSession {
 public:
  GlSession(GlBackend backend, GlEnvironment environment)
      : backend_(backend), writes_out_(environment.written_out), worker_(backend, std::move(environment)) {}

  // One round trip. The memory shared with the worker holds at least `memory_size` bytes; `fill` writes there what the
  // worker is to read. UserError where the shader is rejected or lacks something, BackendError where the driver cannot.
  DrawReply exchange(const Bundle& bundle, const ShaderSource& source, DrawRequest& request, std::size_t memory_size,
                     const std::function<void()>& fill);
  std::byte* memory() const { return shared_.data(); }
  bool started() const { return started_; }  // a worker has had a context to draw with
  bool writes_out() const { return writes_out_; }
  std::vector<std::pair<std::string, std::string>> settings() const { return worker_.settings(); }

 private:
  [[noreturn]] void fail(const ShaderSource& source, const DrawReply& reply);

  const GlBackend backend_;
  const bool writes_out_;
  WorkerProcess worker_;
  BundleImage image_;
  SharedMemory shared_;
  bool started_ = false;
};

// Inputs that `attributes` supply. What is declared but never used may be missing; UserError for other missing or
// mismatched ones.
std::vector<Input> supplied_inputs(const std::vector<Attribute>& attributes, const ShaderSource& source,
                                   const std::vector<Input>& inputs);

// Size, geometry, leaves and uniforms; no programs yet.
DrawRequest request_for(const Bundle& bundle, const ShaderSource& source, const ShaderGenerator& generator,
                        double time_limit_seconds);

// The bundle's uniforms, and the names of those that keep the value they are declared with.
void put_uniforms(const Bundle& bundle, const ShaderSource& source, DrawRequest& request);

}  // namespace twinshade::gl
