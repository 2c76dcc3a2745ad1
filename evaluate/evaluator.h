// Runs a fragment shader over a table, on any backend: the CPU by its translation (any number type), OpenGL in worker
// processes. A fragment a row, at the same place of a grid everywhere (raster/row_grid.h); gl_FragCoord is (x + 0.5, y
// + 0.5, 0.5, 1), gl_FrontFacing true, gl_PrimitiveID 0. Varyings keep their values: interpolation qualifiers mean
// nothing.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"
#include "evaluate/values.h"
#include "raster/renderer.h"

namespace twinshade {

struct Reflection;

enum class Backend : std::uint8_t { cpu, egl, osmesa, softpipe, gpu };
inline constexpr Backend kBackends[] = {Backend::cpu, Backend::egl, Backend::osmesa, Backend::softpipe, Backend::gpu};
const char* backend_name(Backend backend);

// One machine to run on.
struct EvaluationTarget {
  Backend backend = Backend::cpu;
  // cpu only. Lanes run on the instruction set whose registers hold them, unless one is named (isa baseline runs any).
  Number number = Number::lanes4;
  std::optional<Isa> isa;
  bool keep_denormals = false;  // cpu only: as softpipe does, instead of flushing them

  bool operator==(const EvaluationTarget&) const = default;
};

struct EvaluatorOptions {
  double time_limit_seconds = 60;  // of one run on OpenGL
  bool host_fma = true;            // false: llvmpipe without fused multiply-add
  bool written_out = false;        // gpu: as GlEnvironment::written_out
};

// More outputs than OpenGL has colour attachments are refused on every backend. Those of probes do not count: no row's
// outputs are attachments.
inline constexpr std::size_t kMostOutputs = 8;

class Evaluator {
 public:
  explicit Evaluator(EvaluatorOptions options = {});
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  // Translates and compiles shaders for the CPU targets in batches, on all threads. run() does the same for one shader
  // at a time when it was not prepared. Never throws because of a shader: what is wrong with it, run() says.
  using Progress = std::function<void(const std::string& stage, std::size_t done, std::size_t all)>;
  void prepare(std::span<const ShaderSource> shaders, std::span<const EvaluationTarget> targets,
               const Progress& progress = {});

  // The translator's view of a shader: inputs, outputs, uniforms. UserError where it cannot be translated. Stays valid
  // until forget().
  const Reflection& reflection(const ShaderSource& shader);

  // From one thread at a time. UserError, naming the shader's file: it cannot be translated, has too many outputs, or
  // does not fit the table (names with the nearest suggested, types). BackendError, naming the backend: missing,
  // crashed, over the time limit; a backend that could not start is not tried again.
  EvaluatedRows run(const ShaderSource& shader, const ValueTable& table, const EvaluationTarget& target);

  // Drops what prepare() and run() keep of shaders. Loaded code stays.
  void forget();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace twinshade
