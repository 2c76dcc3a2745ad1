#include "tests/evaluate/tables.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>

#include "base/error.h"

namespace twinshade::test {

ShaderSource fragment(const std::string& text) { return resolve_shader("test", text, "test.frag"); }

Values floats(const std::string& name, const std::string& type, const std::vector<float>& values) {
  Values result{name, find_type(type).value(), {}, {}};
  for (const float value : values) result.bits.push_back(std::bit_cast<std::uint32_t>(value));
  return result;
}

Values ints(const std::string& name, const std::string& type, const std::vector<std::int64_t>& values) {
  Values result{name, find_type(type).value(), {}, {}};
  for (const std::int64_t value : values) result.bits.push_back(std::uint32_t(value));
  return result;
}

std::string name_of(const EvaluationTarget& target) {
  return std::string(backend_name(target.backend)) +
         (target.backend == Backend::cpu ? " number " + std::to_string(int(target.number)) : "");
}

std::vector<EvaluationTarget> every_target() {
  static const std::vector<EvaluationTarget> targets = [] {
    std::vector<EvaluationTarget> found{{Backend::cpu, Number::lanes4, {}}, {Backend::cpu, Number::scalar, {}}};
    Evaluator evaluator;
    for (const Backend backend : {Backend::egl, Backend::osmesa, Backend::softpipe}) {
      const std::string error = error_of([&] {
        evaluator.run(fragment("out float r;\nvoid main() { r = 1.0; }\n"), {1, {}, {}, {}, {}}, {backend, {}, {}});
      });
      if (error.empty())
        found.push_back({backend, {}, {}});
      else
        MESSAGE("not tested: ", error);
    }
    return found;
  }();
  return targets;
}

std::vector<std::string> listing(const EvaluatedRows& rows) {
  std::vector<std::string> lines;
  for (std::size_t row = 0; row < rows.kept.size(); ++row) {
    if (rows.kept[row] == 0) lines.push_back(fmt::format("row {}: discarded", row));
    if (rows.kept[row] == 0) continue;
    for (const Values& values : rows.outputs)
      for (std::uint32_t c = 0; c < values.type.components(); ++c)
        lines.push_back(fmt::format("row {}: {} = {:a} (0x{:08x})", row, component_name(values.name, values.type, c),
                                    value_at(values, row, c), values.bits[row * values.type.components() + c]));
  }
  return lines;
}

}  // namespace twinshade::test
