#include "evaluate/evaluator.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/parallel.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/rewrite/probe.h"
#include "evaluate/bind_table.h"
#include "evaluate/cpu_rows.h"
#include "evaluate/prepared_shaders.h"
#include "raster/row_grid.h"
#if TWINSHADE_HAS_GL
#include "raster/gl/gl_rows.h"
#endif

namespace twinshade {
namespace {

constexpr const char* kNames[] = {"cpu", "egl", "osmesa", "softpipe", "gpu"};

static_assert(kMostTableRows <= kMostGridRows);

// Outputs in order of declaration, with no values yet.
std::vector<Values> empty_outputs(const Reflection& reflection, std::size_t rows) {
  std::vector<Values> outputs;
  for (const ReflectedVariable& output : reflection.outputs) outputs.push_back({output.name, type_of(output), {}, {}});
  if (reflection.writes_depth) outputs.push_back({"gl_FragDepth", {}, {}, {}});
  for (Values& values : outputs) values.bits.resize(rows * values.type.components());
  return outputs;
}

std::size_t own_outputs(const Reflection& reflection) {
  return std::size_t(
      std::count_if(reflection.outputs.begin(), reflection.outputs.end(),
                    [](const ReflectedVariable& v) { return v.name != kProbeValue && v.name != kProbePlace; }));
}

}  // namespace

const char* backend_name(Backend backend) { return kNames[int(backend)]; }

struct Evaluator::State {
  explicit State(const EvaluatorOptions& o) : options(o) {}

  void run_cpu(const ShaderSource& shader, const EvaluationTarget& target, const BoundRows& group,
               EvaluatedRows& result) {
    const PreparedShaders::Code code = shaders.code(shader, target.number, target.isa);
    const CpuRows rows = run_cpu_rows(*code.module, *code.entry, group, target.keep_denormals);
    std::size_t from = 0;
    for (Values& values : result.outputs) {
      if (!rows.doubles.empty()) values.doubles.resize(values.bits.size());
      const std::uint32_t components = values.type.components();
      for (std::uint32_t c = 0; c < components; ++c)
        for (const std::size_t row : group.rows) {
          if (!rows.doubles.empty()) values.doubles[row * components + c] = rows.doubles[from];
          values.bits[row * components + c] = rows.bits[from++];
        }
    }
    for (std::size_t i = 0; i < group.rows.size(); ++i) result.kept[group.rows[i]] = rows.kept[i];
    result.provenance = {{"isa", kIsaNames[int(code.entry->isa)]}};
  }

#if TWINSHADE_HAS_GL
  RowRenderer& renderer(Backend backend) {
    std::unique_ptr<RowRenderer>& made = renderers[backend];
    if (!made) {
      const GlBackend gl = backend == Backend::egl      ? GlBackend::egl
                           : backend == Backend::osmesa ? GlBackend::osmesa
                           : backend == Backend::gpu    ? GlBackend::gpu
                                                        : GlBackend::softpipe;
      made = make_gl_row_renderer(
          gl, {thread_count(), options.host_fma, options.written_out && backend == Backend::gpu, {}});
    }
    return *made;
  }

  void run_gl(const ShaderSource& shader, const EvaluationTarget& target, const BoundRows& group,
              EvaluatedRows& result) {
    if (const auto dead = dead_backends.find(target.backend); dead != dead_backends.end())
      throw BackendError(dead->second);
    RowRenderer& backend = renderer(target.backend);
    RowResults rows;
    try {
      rows = backend.run({group.rows.size(), group.inputs, group.resources}, shader, options.time_limit_seconds);
    } catch (const BackendError& error) {
      if (!backend.started()) dead_backends[target.backend] = error.what();
      throw;
    }
    std::map<std::string, std::size_t> plane_of;
    for (std::size_t i = 0; i < rows.names.size(); ++i) plane_of[rows.names[i]] = i * group.rows.size();
    for (Values& values : result.outputs) {
      const std::uint32_t components = values.type.components();
      for (std::uint32_t c = 0; c < components; ++c) {
        const std::string name = component_name(values.name, values.type, c);
        const auto plane = plane_of.find(name);
        if (plane == plane_of.end())
          throw BackendError(std::string(backend_name(target.backend)) + ": there are no results for output " + name);
        for (std::size_t i = 0; i < group.rows.size(); ++i)
          values.bits[group.rows[i] * components + c] = rows.bits[plane->second + i];
      }
    }
    for (std::size_t i = 0; i < group.rows.size(); ++i) result.kept[group.rows[i]] = rows.kept[i];
    result.provenance = std::move(rows.provenance);
  }

  std::map<Backend, std::unique_ptr<RowRenderer>> renderers;
#else
  void run_gl(const ShaderSource&, const EvaluationTarget& target, const BoundRows&, EvaluatedRows&) {
    throw BackendError(std::string(backend_name(target.backend)) +
                       ": this build has no OpenGL backends (TWINSHADE_GL=OFF)");
  }
#endif

  EvaluatorOptions options;
  PreparedShaders shaders;
  std::map<Backend, std::string> dead_backends;
};

Evaluator::Evaluator(EvaluatorOptions options) : state_(std::make_unique<State>(options)) {}
Evaluator::~Evaluator() = default;

void Evaluator::prepare(std::span<const ShaderSource> shaders, std::span<const EvaluationTarget> targets,
                        const Progress& progress) {
  state_->shaders.prepare(shaders, targets, progress);
}

const Reflection& Evaluator::reflection(const ShaderSource& shader) {
  return state_->shaders.translation(shader).reflection;
}

EvaluatedRows Evaluator::run(const ShaderSource& shader, const ValueTable& table, const EvaluationTarget& target) {
  const Reflection& shape = reflection(shader);
  if (const std::size_t count = own_outputs(shape); count > kMostOutputs)
    throw UserError((shader.files.empty() ? shader.name : shader.files[0]) + ": the shader has " +
                    std::to_string(count) + " outputs, but at most " + std::to_string(kMostOutputs) +
                    " can be evaluated: split it");
  EvaluatedRows result;
  result.outputs = empty_outputs(shape, table.rows);
  result.kept.resize(table.rows);
  for (const BoundRows& group : bind_table(shader, shape, table)) {
    if (target.backend == Backend::cpu)
      state_->run_cpu(shader, target, group, result);
    else
      state_->run_gl(shader, target, group, result);
  }
  return result;
}

void Evaluator::forget() { state_->shaders.forget(); }

}  // namespace twinshade
