#include "check/first_line.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "check/compare_rows.h"

namespace twinshade {
namespace {

constexpr std::size_t kMostValues = 8192;               // of one invocation
constexpr std::size_t kMostStatements = 512;            // tried on the other machine: each is compiled there
constexpr std::size_t kMostLlvmpipeIterations = 65535;  // of a loop, which it then leaves: lp_bld_limits.h

bool is_llvmpipe(const EvaluationTarget& machine) {
  return machine.backend == Backend::egl || machine.backend == Backend::osmesa;
}

struct TracedValue {
  std::size_t value = 0;                   // of ProbedShader::values
  std::array<std::uint32_t, 3> element{};  // of the arrays on the way to it
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
    const bool tiny = std::abs(x) < 0x1p-126f && std::abs(y) < 0x1p-126f;
    const bool flushed = tiny && std::signbit(x) == std::signbit(y);  // which keeps the sign
    if (!(std::isnan(x) && std::isnan(y)) && !flushed) return false;
  }
  return true;
}

// Of a float that is converted to "int", "ivec3", "uint" ...
bool is_in_range(float value, const std::string& type) {
  return type[0] == 'u' ? value > -1 && value < 0x1p32f : value >= -0x1p31f && value < 0x1p31f;
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
      const std::uint32_t type = place->bits[at + 2], elements = place->bits[at + 3];
      traced.value = place->bits[at] - 1;
      traced.element = {elements & 0xffffu, elements >> 16, type >> 16};
      traced.scalar = Scalar(type & 3u);
      traced.components = std::clamp(type >> 2 & 7u, 1u, 4u);
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

// "s.second", "P[2]", "w[3].x"
std::string name_of(const ProbedValue& value, const TracedValue& traced) {
  std::string name = value.name[0];
  for (std::size_t i = 1; i < value.name.size(); ++i)
    name += (i <= traced.element.size() ? "[" + std::to_string(traced.element[i - 1]) + "]" : "[]") + value.name[i];
  return name;
}

class Search {
 public:
  Search(Evaluator& evaluator, const ShaderSource& source, const ValueTable& table, std::size_t row,
         const EvaluationTarget& a, const EvaluationTarget& b)
      : tracer_(evaluator, table, row), source_(source), all_(add_probes(source)), a_(a), b_(b) {
    const std::size_t count = std::min(tracer_.run(all_.source, a, 1).all, kMostValues);
    trace_ = tracer_.run(all_.source, a, std::max<std::size_t>(count, 1));
    for (std::size_t t = 0; t < trace_.values.size(); ++t) {
      const std::size_t statement = statement_of(trace_.values[t]);
      std::vector<std::size_t>& of_statement = times_[statement];
      if (of_statement.empty() && all_.statements[statement].converted_to.empty()) order_.push_back(statement);
      of_statement.push_back(t);
    }
  }

  // What computes is looked at first. The others, which seldom differ, are looked at alone if they do together, or if
  // there is nothing else.
  FirstLine run() {
    std::vector<std::size_t> computing, others;
    for (const std::size_t statement : order_)
      (all_.statements[statement].computes ? computing : others).push_back(statement);
    one_by_one(computing);
    if (found_) std::erase_if(others, [&](std::size_t statement) { return times_[statement].front() > found_->time; });
    if (!others.empty() && (!found_ || differ({others.begin(), others.end()}))) one_by_one(others);
    FirstLine result;
    result.difference = found_;
    if (!found_) result.note = why_none() + perhaps_cut_loop();
    return result;
  }

 private:
  std::size_t statement_of(const TracedValue& traced) const { return all_.values[traced.value].statement; }

  // Until none that is left could come before the first that differs.
  void one_by_one(const std::vector<std::size_t>& statements) {
    for (const std::size_t statement : statements) {
      if (found_ && times_[statement].front() > found_->time) return;
      if (looked_at_ == kMostStatements) {
        cut_short_ = true;
        return;
      }
      ++looked_at_;
      differ({statement});
    }
  }

  // Whether the other machine has other values for these statements, told of in one program; one alone is noted.
  bool differ(const std::set<std::size_t>& statements) {
    std::vector<std::size_t> when;
    for (const std::size_t statement : statements)
      when.insert(when.end(), times_[statement].begin(), times_[statement].end());
    std::sort(when.begin(), when.end());
    const Trace other = tracer_.run(add_probes(source_, statements).source, b_, when.size());
    for (std::size_t k = 0; k < when.size() && k < other.values.size(); ++k) {
      const TracedValue &x = trace_.values[when[k]], &y = other.values[k];
      if (x.value == y.value && same(x, y)) continue;
      if (statements.size() == 1 && (!found_ || when[k] < found_->time)) note(when[k], y);
      return true;
    }
    return false;
  }

  void note(std::size_t time, const TracedValue& y) {
    const TracedValue& x = trace_.values[time];
    LineDifference difference;
    difference.statement = all_.statements[statement_of(x)];
    difference.statement.what = name_of(all_.values[x.value], x);
    difference.time = time;
    difference.occurrence = executions(time);
    difference.scalar = x.scalar;
    difference.components = x.components;
    difference.a = x.bits;
    difference.b = y.bits;
    difference.cause = conversion_out_of_range(difference.statement, time);
    found_ = std::move(difference);
  }

  // On the lines of what differs, as they were executed last before it.
  std::string conversion_out_of_range(const ProbedStatement& differing, std::size_t time) const {
    for (const auto& [statement, times] : times_) {
      const ProbedStatement& conversion = all_.statements[statement];
      const bool is_there = !conversion.converted_to.empty() && conversion.file == differing.file &&
                            conversion.line >= differing.line && conversion.last_line <= differing.last_line;
      const auto behind = std::lower_bound(times.begin(), times.end(), time);
      if (!is_there || behind == times.begin()) continue;
      const TracedValue& operand = trace_.values[*std::prev(behind)];
      for (std::uint32_t c = 0; c < operand.components; ++c)
        if (!is_in_range(std::bit_cast<float>(operand.bits[c]), conversion.converted_to))
          return conversion.converted_to + "() of " + value_text(Scalar::f32, operand.bits[c]) +
                 ": GLSL leaves open what integer a float gives that is out of range or NaN: test or clamp it first";
    }
    return "";
  }

  // A statement tells of each of its values once in an execution.
  std::size_t executions(std::size_t last) const {
    const TracedValue& one = trace_.values[last];
    return std::size_t(
        std::count_if(trace_.values.begin(), trace_.values.begin() + std::ptrdiff_t(last) + 1,
                      [&](const TracedValue& v) { return v.value == one.value && v.element == one.element; }));
  }

  std::string why_none() const {
    if (cut_short_)
      return "none of the first " + std::to_string(looked_at_) + " statements differs when it is looked at (of " +
             std::to_string(order_.size()) + ")";
    if (trace_.all > kMostValues) return "none of the first " + std::to_string(kMostValues) + " values differs";
    if (!all_.complete)
      return "no value differs of those that can be looked at (not doubles, stores through an index that calls a "
             "function, nor arrays that a condition stores)";
    return "no value differs when it is looked at: the difference needs several statements compiled as one, or is in "
           "an output that is never written";
  }

  std::string perhaps_cut_loop() const {
    if (trace_.all <= kMostLlvmpipeIterations || is_llvmpipe(a_) == is_llvmpipe(b_)) return "";
    return "; " + std::string(backend_name((is_llvmpipe(a_) ? a_ : b_).backend)) + " leaves every loop after " +
           std::to_string(kMostLlvmpipeIterations) + " iterations, and " + std::to_string(trace_.all) +
           " values are computed here";
  }

  const Tracer tracer_;
  const ShaderSource& source_;
  const ProbedShader all_;
  const EvaluationTarget &a_, &b_;
  Trace trace_;
  std::map<std::size_t, std::vector<std::size_t>> times_;  // of a statement's values
  std::vector<std::size_t> order_;                         // statements by when they are first executed
  std::optional<LineDifference> found_;
  std::size_t looked_at_ = 0;
  bool cut_short_ = false;
};

}  // namespace

FirstLine first_differing_line(Evaluator& evaluator, const ShaderSource& source, const ValueTable& table,
                               std::size_t row, const EvaluationTarget& a, const EvaluationTarget& b) {
  return Search(evaluator, source, table, row, a, b).run();
}

}  // namespace twinshade
