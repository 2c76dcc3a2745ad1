#include "check/first_line.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "base/error.h"
#include "check/compare_rows.h"

namespace twinshade {
namespace {

constexpr std::size_t kMostValues = 8192;     // of one invocation
constexpr std::size_t kMostStatements = 512;  // tried on the other machine

struct TracedValue {
  std::size_t statement = 0;
  Scalar scalar = Scalar::f32;
  std::uint32_t components = 1;
  std::array<std::uint32_t, 4> bits{};
};

struct Trace {
  std::vector<TracedValue> values;
  std::size_t all = 0;  // values that the invocation computed
};

bool same(const TracedValue& a, const TracedValue& b) {
  if (a.scalar != b.scalar || a.components != b.components) return false;
  for (std::uint32_t c = 0; c < a.components; ++c) {
    if (a.bits[c] == b.bits[c]) continue;
    if (a.scalar != Scalar::f32) return false;
    const auto x = std::bit_cast<float>(a.bits[c]), y = std::bit_cast<float>(b.bits[c]);
    const bool tiny = std::abs(x) < 0x1p-126f && std::abs(y) < 0x1p-126f;  // one may have been flushed
    const bool zeros = x == 0 && y == 0;
    if (!(std::isnan(x) && std::isnan(y)) && (!tiny || zeros)) return false;
  }
  return true;
}

class Tracer {
 public:
  Tracer(Evaluator& evaluator, const ValueTable& table, std::size_t row)
      : evaluator_(evaluator), table_(table), row_(row) {}

  // Values `targets` of the invocation, by their place in the order of execution.
  Trace run(const ShaderSource& probed, const EvaluationTarget& machine, std::size_t count) const {
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t r = 0; r < table_.rows; ++r) rows.push_back(r);
    ValueTable table = select_rows(table_, rows);
    Values target;
    target.name = kProbeTarget;
    target.type.scalar = Scalar::i32;
    for (std::size_t k = 0; k < rows.size(); ++k) target.bits.push_back(std::uint32_t(k / table_.rows));
    table.inputs.push_back(std::move(target));
    const EvaluatedRows result = evaluator_.run(probed, table, machine);
    const Values* value = find_values(result.outputs, kProbeValue);
    const Values* place = find_values(result.outputs, kProbePlace);
    TWINSHADE_CHECK_EQ(value != nullptr && place != nullptr, true);
    Trace trace;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = (k * table_.rows + row_) * 4;
      trace.all = place->bits[at + 1];
      if (place->bits[at] == 0) break;
      TracedValue traced;
      traced.statement = place->bits[at] - 1;
      traced.scalar = place->bits[at + 2] != 0 ? Scalar::f32 : Scalar::i32;
      traced.components = std::clamp(place->bits[at + 3], 1u, 4u);
      std::copy_n(value->bits.begin() + std::ptrdiff_t(at), 4, traced.bits.begin());
      trace.values.push_back(traced);
    }
    return trace;
  }

 private:
  Evaluator& evaluator_;
  const ValueTable& table_;
  const std::size_t row_;
};

}  // namespace

FirstLine first_differing_line(Evaluator& evaluator, const ShaderSource& source, const ValueTable& table,
                               std::size_t row, const EvaluationTarget& a, const EvaluationTarget& b) {
  const ProbedShader all = add_probes(source);
  const Tracer tracer(evaluator, table, row);
  const std::size_t count = std::min(tracer.run(all.source, a, 1).all, kMostValues);
  const Trace trace = tracer.run(all.source, a, std::max<std::size_t>(count, 1));

  // Statements by when they are first executed, each with the times of its values.
  std::map<std::size_t, std::vector<std::size_t>> times;
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < trace.values.size(); ++t) {
    std::vector<std::size_t>& of_statement = times[trace.values[t].statement];
    if (of_statement.empty()) order.push_back(trace.values[t].statement);
    of_statement.push_back(t);
  }

  FirstLine found;
  if (order.size() > kMostStatements) order.resize(kMostStatements);
  for (const std::size_t statement : order) {
    const std::vector<std::size_t>& when = times[statement];
    if (found.difference && when.front() > found.difference->time) break;
    const Trace other = tracer.run(add_probes(source, statement).source, b, when.size());
    for (std::size_t k = 0; k < when.size() && k < other.values.size(); ++k) {
      const TracedValue &x = trace.values[when[k]], &y = other.values[k];
      if (same(x, y)) continue;
      if (!found.difference || when[k] < found.difference->time)
        found.difference =
            LineDifference{all.statements[statement], when[k], k + 1, x.scalar, x.components, x.bits, y.bits};
      break;
    }
  }
  if (!found.difference)
    found.note = trace.all > kMostValues
                     ? "none of the first " + std::to_string(kMostValues) + " values differs"
                     : "no value differs when it is looked at: the difference needs several statements compiled as one";
  return found;
}

}  // namespace twinshade
