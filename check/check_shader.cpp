#include "check/check_shader.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <deque>
#include <new>

#include "base/error.h"
#include "check/shrink.h"
#include "cpu_shaders/rewrite/exact_names.h"
#include "cpu_shaders/rewrite/frag_coord.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "cpu_shaders/source/line_names.h"
#include "golden/content_hashes.h"
#include "raster/row_grid.h"

namespace twinshade {
namespace {

constexpr const char* kFragCoord = "gl_FragCoord";

class Check {
 public:
  Check(Evaluator& evaluator, const std::string& path, const CheckOptions& options)
      : evaluator_(evaluator), options_(options) {
    result_.path = path;
  }

  // What is to be compiled; null where the shader is refused.
  const ShaderSource* load() {
    return guarded([this] { read(); }) ? &source_ : nullptr;
  }

  CheckedShader run() {
    if (!result_.message.empty()) return std::move(result_);
    const bool compared = guarded([this] {
      generate();
      compare();
    });
    if (!compared) return std::move(result_);
    // The verdict stands, whatever goes wrong from here on.
    if (const BackendCheck* differing = first_differing()) explain_guarded(*differing);
    if (options_.timing) time();
    return std::move(result_);
  }

 private:
  bool guarded(const std::function<void()>& step) {
    try {
      step();
      return true;
    } catch (const UserError& error) {
      result_.verdict = Verdict::refused;
      result_.message = authors_text(error.what());
    } catch (const BackendError& error) {  // of the machine that the others are compared with
      result_.verdict = Verdict::not_run;
      result_.message = authors_text(error.what());
    } catch (const std::bad_alloc&) {  // the others would not have memory either
      throw;
    } catch (const std::exception& error) {  // our own mistake: the others are checked all the same
      result_.verdict = Verdict::not_run;
      result_.message = result_.path + ": " + error.what();
    }
    return false;
  }

  // With the author's names, of files too.
  std::string authors_text(std::string text) const {
    return with_real_names(result_.files, as_the_author_names(exact_, std::move(text)));
  }

  void read() {
    source_ = load_fragment_shader(result_.path, options_.source);
    result_.files = source_.files;
    ranges_ = all_ranges(source_, result_.path, options_.inputs_file);
    if (options_.make_exact) {
      exact_ = make_exact(source_);
      for (InputRange& range : ranges_) range.name = path_in(exact_, range.name);
      source_ = exact_.source;
      result_.findings = exact_.left;
    } else {
      result_.findings = lint(source_);
    }
    for (LintFinding& finding : result_.findings) finding.file = with_real_names(result_.files, finding.file);
    result_.hash = content_hash(source_);
  }

  void generate() {
    Reflection reflection = evaluator_.reflection(source_);
    uses_frag_coord_ = reflection.uses_frag_coord;
    group_ = reflection.uses_derivatives ? 4 : 1;
    // What --make-exact added is none of the author's inputs.
    if (exact_.uses_zero)
      std::erase_if(reflection.uniforms, [](const auto& uniform) { return uniform.name == kExactZero; });
    use_block_names(reflection, ranges_);
    table_ = generate_rows(reflection, ranges_, options_.generate);
    if (!exact_.uses_zero) return;
    Values zero;
    zero.name = kExactZero;
    zero.bits = {0};
    table_.uniforms.push_back(std::move(zero));
  }

  void compare() {
    const EvaluatedRows reference = evaluator_.run(source_, table_, options_.on[0]);
    result_.backends.push_back({options_.on[0], "", {}, 0, reference.provenance});
    std::size_t compared = 0, refused = 0;
    bool bits_differ = false;
    std::vector<RowComparison> beyond(1);  // what of each comparison is beyond the distance that is called the same
    for (std::size_t i = 1; i < options_.on.size(); ++i) {
      BackendCheck check{options_.on[i], "", {}, 0};
      try {
        const Both both = run(source_, table_, options_.on[i], &reference);
        check.provenance = both.b.provenance;
        check.comparison = compare_rows(both.a, both.b, both.leave_out);
        beyond.push_back(compare_rows(both.a, both.b, both.leave_out, options_.ulp));
        if (check.comparison.compared == 0) throw BackendError(every_row_left_out(options_.on[i]));
        ++compared;
        bits_differ |= !check.comparison.rows.empty();
        result_.max_ulp = std::max(result_.max_ulp, check.comparison.max_ulp);
      } catch (const BackendError& error) {
        check.not_run = authors_text(error.what());
      } catch (const UserError& error) {  // its driver takes less than the first backend does
        check.not_run = authors_text(error.what());
        ++refused;
      }
      beyond.resize(i + 1);
      result_.backends.push_back(std::move(check));
    }
    // +0 and -0 are 0 apart; discarding is at no distance
    const bool close = options_.ulp &&
                       std::all_of(beyond.begin(), beyond.end(), [](const RowComparison& c) { return c.rows.empty(); });
    const bool all_refuse = refused > 0 && refused + 1 == result_.backends.size();
    result_.verdict = all_refuse      ? Verdict::refused
                      : compared == 0 ? Verdict::not_run
                      : !bits_differ  ? Verdict::same_bits
                      : close         ? Verdict::same_to_ulp
                                      : Verdict::differs;
    if (options_.ulp && result_.verdict == Verdict::differs) {  // told of and searched is what makes it so
      allowed_ = options_.ulp;
      for (std::size_t i = 1; i < beyond.size(); ++i) result_.backends[i].comparison = std::move(beyond[i]);
    }
    if (compared == 0)
      result_.message = result_.backends.size() < 2 ? "there is nothing to compare with" : result_.backends[1].not_run;
  }

  std::string every_row_left_out(const EvaluationTarget& other) const {
    return std::string(backend_name(other.backend)) +
           ": not compared: every row has a denormal input or uniform, which softpipe keeps and " +
           backend_name((other.backend == Backend::softpipe ? options_.on[0] : other).backend) + " flushes";
  }

  const BackendCheck* first_differing() const {
    for (const BackendCheck& check : result_.backends)
      if (!check.comparison.rows.empty()) return &check;
    return nullptr;
  }

  // Rows of a table in groups: whether the two machines differ in each by more than flushed denormals and allowed_.
  std::vector<bool> differs(const ShaderSource& source, const ValueTable& table, const EvaluationTarget& other) {
    std::vector<bool> groups(table.rows / group_);
    for (const std::size_t row : compare(source, table, other).rows) groups[row / group_] = true;
    return groups;
  }

  // The two machines that are compared: the first backend and another.
  struct Machines {
    EvaluationTarget a, b;
    bool without_denormals = false;  // in inputs and uniforms
  };

  // softpipe keeps the denormals that the others flush: beside it the CPU keeps them too, whichever comes first.
  Machines machines(const EvaluationTarget& other) const {
    Machines pair{options_.on[0], other};
    const auto beside_softpipe = [](EvaluationTarget& target, const EvaluationTarget& beside) {
      if (beside.backend == Backend::softpipe && target.backend == Backend::cpu) target.keep_denormals = true;
      return beside.backend == Backend::softpipe && target.backend != Backend::cpu;
    };
    const bool first = beside_softpipe(pair.a, pair.b), second = beside_softpipe(pair.b, pair.a);
    pair.without_denormals = first || second;
    return pair;
  }

  struct Both {
    EvaluatedRows a, b;
    std::vector<bool> leave_out;  // as compare_rows has it
  };

  // reference: what the first backend computed, where that is known.
  Both run(const ShaderSource& source, const ValueTable& table, const EvaluationTarget& other,
           const EvaluatedRows* reference = nullptr) {
    const Machines pair = machines(other);
    const bool known = reference != nullptr && pair.a == options_.on[0];
    return {known ? *reference : evaluator_.run(source, table, pair.a), evaluator_.run(source, table, pair.b),
            pair.without_denormals ? rows_with_denormals(table) : std::vector<bool>()};
  }

  RowComparison compare(const ShaderSource& source, const ValueTable& table, const EvaluationTarget& other) {
    const Both both = run(source, table, other);
    return compare_rows(both.a, both.b, both.leave_out, allowed_);
  }

  void explain_guarded(const BackendCheck& differing) {
    try {
      explain(differing);
    } catch (const std::exception& error) {
      if (result_.counterexample) result_.counterexample->first_line.note = error.what();
    }
    if (result_.counterexample) as_the_author_wrote(*result_.counterexample);
  }

  // Without the inputs that were added, and by the author's names.
  void as_the_author_wrote(Counterexample& example) const {
    if (exact_.uses_zero) std::erase_if(example.values.uniforms, [](const Values& v) { return v.name == kExactZero; });
    const auto name = [this](std::string& text) { text = authors_text(std::move(text)); };
    for (std::vector<Values>* list : {&example.values.inputs, &example.values.uniforms})
      for (Values& values : *list) name(values.name);
    name(example.difference.output);
    name(example.first_line.note);
    if (example.first_line.difference) {
      ProbedStatement& statement = example.first_line.difference->statement;
      name(statement.what);
      statement.file = with_real_names(result_.files, statement.file);
    }
    if (!uses_frag_coord_) return;
    for (Values& values : example.values.inputs)
      if (values.name == kRowFragCoord) values.name = kFragCoord;
    if (!example.first_line.difference) return;
    std::string& what = example.first_line.difference->statement.what;
    for (std::size_t at = 0; (at = what.find(kRowFragCoord, at)) != std::string::npos;)
      what.replace(at, std::string_view(kRowFragCoord).size(), kFragCoord);
  }

  void explain(const BackendCheck& differing) {
    Counterexample example;
    example.a = options_.on[0].backend;
    example.b = differing.target.backend;
    example.difference = *differing.comparison.first;
    const std::size_t row = example.difference.row, first = row / group_ * group_;
    std::vector<std::size_t> rows;
    for (std::size_t r = first; r < first + group_; ++r) rows.push_back(std::min(r, table_.rows - 1));
    example.row = row - first;
    example.values = select_rows(table_, rows);
    result_.counterexample = example;  // what there is to tell, should the search fail
    ShaderSource source = source_;
    if (uses_frag_coord_) {  // a row keeps its place while it is moved about
      source = frag_coord_as_input(source_);
      add_frag_coord(example.values, rows);
    }
    const Differs test = [&](const ValueTable& table) { return differs(source, table, differing.target); };
    if (!test(example.values)[0]) {  // the rows beside it have a part in it: no one input shows it
      result_.counterexample.reset();
      result_.message = only_in_company(example);
      return;
    }
    example.values = shrink(example.values, ranges_, test);
    const RowComparison shrunk = compare(source, example.values, differing.target);
    if (shrunk.first) {
      example.difference = *shrunk.first;
      example.row = shrunk.first->row;
    }
    result_.counterexample = std::move(example);
    look_inside(source, differing.target, *result_.counterexample);
  }

  std::string only_in_company(const Counterexample& example) const {
    const RowDifference& d = example.difference;
    return as_the_author_names(exact_, d.output) + ": " + backend_name(example.a) + " " + value_text(d.scalar, d.a) +
           ", " + backend_name(example.b) + " " + value_text(d.scalar, d.b) + " in row " + std::to_string(d.row + 1) +
           " of " + std::to_string(table_.rows) + "; the difference is not there when that row is run alone";
  }

  void look_inside(const ShaderSource& source, const EvaluationTarget& other, Counterexample& example) {
    const Machines pair = machines(other);
    try {
      example.first_line = first_differing_line(evaluator_, source, example.values, example.row, pair.a, pair.b);
    } catch (const UserError& error) {
      example.first_line.note = std::string("cannot be looked for: ") + error.what();
    }
    example.constant_folding = by_constant_folding(source, example.values, other);
  }

  // Rows lie on the grid among those that share their uniforms.
  std::size_t place_on_grid(std::size_t row) const {
    std::size_t place = 0;
    for (std::size_t before = 0; before < row; ++before) {
      const bool same = std::all_of(table_.uniforms.begin(), table_.uniforms.end(), [&](const Values& values) {
        const auto begin = values.bits.begin();
        const auto n = std::ptrdiff_t(values.type.components());
        return values.row_count() == 1 ||
               std::equal(begin + std::ptrdiff_t(before) * n, begin + std::ptrdiff_t(before + 1) * n,
                          begin + std::ptrdiff_t(row) * n);
      });
      if (same) ++place;
    }
    return place;
  }

  void add_frag_coord(ValueTable& values, const std::vector<std::size_t>& rows) const {
    Values coord;
    coord.name = kRowFragCoord;
    coord.type.rows = 4;
    for (const std::size_t row : rows) {
      const auto [x, y] = grid_pixel(place_on_grid(row));
      for (const float c : {float(x) + 0.5f, float(y) + 0.5f, 0.5f, 1.0f})
        coord.bits.push_back(std::bit_cast<std::uint32_t>(c));
    }
    values.inputs.push_back(std::move(coord));
  }

  // Whether the machines agree once neither compiler folds constants.
  bool by_constant_folding(const ShaderSource& source, ValueTable values, const EvaluationTarget& other) {
    if (options_.make_exact) return false;
    try {
      const ExactShader unfolded = make_exact(source, ExactScope::constants);
      return unfolded.changed && !differs(unfolded.source, values, other)[0];
    } catch (const UserError&) {
      return false;  // the rewritten shader is none: nothing is known
    }
  }

  // By the difference between many rows and few, which leaves the cost of starting out.
  void time() {
    constexpr std::size_t kMany = 16384;
    std::vector<std::size_t> many, few;
    for (std::size_t i = 0; i < kMany; ++i) many.push_back(i % std::min<std::size_t>(table_.rows, 256));
    few.assign(many.begin(), many.begin() + 256);
    const ValueTable large = select_rows(one_uniform_set(), many), small = select_rows(one_uniform_set(), few);
    for (BackendCheck& check : result_.backends) {
      if (!check.not_run.empty()) continue;
      try {
        const double seconds = fastest(large, check.target) - fastest(small, check.target);
        check.ns_per_invocation = std::max(0.0, seconds) * 1e9 / double(kMany - few.size());
      } catch (const std::exception&) {  // so many rows take longer than the time limit, say: no time is told
      }
    }
  }

  ValueTable one_uniform_set() const {
    ValueTable table = table_;
    for (Values& values : table.uniforms) values.bits.resize(values.type.components());
    return table;
  }

  double fastest(const ValueTable& table, const EvaluationTarget& target) {
    double best = 1e9;
    for (int run = 0; run < 3; ++run) {
      const auto start = std::chrono::steady_clock::now();
      evaluator_.run(source_, table, target);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
  }

  Evaluator& evaluator_;
  const CheckOptions& options_;
  ShaderSource source_;
  std::vector<InputRange> ranges_;
  ValueTable table_;
  std::size_t group_ = 1;  // rows that belong together: a quad where derivatives are taken
  bool uses_frag_coord_ = false;
  ExactShader exact_;                     // with --make-exact
  std::optional<std::uint64_t> allowed_;  // distance in ULP that does not count as a difference; none: every bit does
  CheckedShader result_;
};

}  // namespace

std::vector<CheckedShader> check_shaders(Evaluator& evaluator, const std::vector<std::string>& paths,
                                         const CheckOptions& options, const CheckProgress& progress) {
  std::deque<Check> checks;
  std::vector<ShaderSource> sources;
  for (const std::string& path : paths) {
    checks.emplace_back(evaluator, path, options);
    if (const ShaderSource* source = checks.back().load()) sources.push_back(*source);
  }
  evaluator.prepare(sources, options.on);
  std::vector<CheckedShader> results;
  for (Check& check : checks) {
    if (progress) progress(results.size());
    const auto start = std::chrono::steady_clock::now();
    results.push_back(check.run());
    results.back().seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return results;
}

}  // namespace twinshade
