#include "app/first_line_search.h"

#include <stdexcept>

#include "app/machines.h"
#include "check/pixel_row.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {

EvaluationTarget target_of(const std::string& backend, const CpuOptions& cpu) {
  EvaluationTarget target;
  target.backend = backend_named(backend);
  target.number = cpu.number.value_or(natural_number(cpu.isa.value_or(machine_isa())));
  target.isa = cpu.isa;
  return target;
}

}  // namespace

FirstLine first_line_at(const ShaderSource& shader, const Bundle& bundle, const Frame& frame, const Difference& at,
                        const std::string& a, const std::string& b, const LineSearchOptions& options) {
  FirstLine line;
  try {
    EvaluatorOptions evaluation;
    evaluation.host_fma = options.host_fma;
    evaluation.time_limit_seconds = options.time_limit_seconds;
    evaluation.written_out = true;  // on gpu alone: so frames are drawn there
    Evaluator evaluator(evaluation);
    const ValueTable table = row_of_pixel(evaluator.reflection(shader), bundle, frame, at.x, at.y);
    line = first_differing_line(evaluator, shader, table, 0, target_of(a, options.cpu), target_of(b, options.cpu));
  } catch (const std::runtime_error& error) {  // UserError, BackendError
    line.note = std::string("not looked for: ") + error.what();
  }
  return line;
}

}  // namespace twinshade
