#include "cpu_shaders/translate/emit_module.h"

#include <algorithm>
#include <regex>

#include "cpu_shaders/translate/emit_function.h"
#include "cpu_shaders/translate/emit_reflection.h"
#include "cpu_shaders/translate/served.h"
#include "cpu_shaders/translate/written_first.h"

namespace twinshade::spirv {
namespace {

class ModuleEmitter {
 public:
  ModuleEmitter(const Program& program, Interface& interface, const SourceLines& lines, NameTable& names,
                const ShaderSource& source, const TranslateOptions& options, Translation& translation)
      : program_(program),
        module_(program.module),
        interface_(interface),
        lines_(lines),
        names_(names),
        source_(source),
        options_(options),
        translation_(translation),
        instances_(analyse_uniformity(program)),
        types_(module_, names, source.precision == Precision::half),
        shared_{program, instances_, interface, lines, types_, names, source.precision, options.readable, "", {}, "", {}, {}} {}

  void run() {
    shared_.out.indent();
    if (source_.precision == Precision::by_line) shared_.half_lines = names_.declare("half_lines");
    name_functions();
    choose_inlined();
    find_varying_indices();
    const std::string tables = aside([&] { constant_tables(); });
    const std::string members = aside([&] { write_members(); });
    const std::string functions = aside([&] { write_functions(); });
    reflect_half_lines();
    interface_.reflection.no_float64_reason = shared_.no_float64_reason;
    translation_.reflection = interface_.reflection;
    const std::string types = aside([&] { types_.write_declarations(shared_.out); });
    translation_.cpp = head();
    if (!options_.code_elsewhere) translation_.cpp += class_head() + types + tables + members + functions + "};\n\n";
    translation_.cpp +=
        reflection_text(interface_.reflection, source_, translation_.identifier, options_.code_elsewhere);
  }

 private:
  template <class Write>
  std::string aside(Write write) {
    const std::size_t mark = shared_.out.mark();
    write();
    std::string text;
    for (const std::string& line : shared_.out.take(mark)) text += line + '\n';
    return text;
  }

  // In the order of the GLSL. Instances beyond the first differ in which arguments vary.
  void name_functions() {
    for (Instance* i : instances_.callees_first)
      i->name = i->info->function->id == module_.entry ? "main" : names_.declare(i->info->function->name);
  }

  // Inlining everything is what GPUs do and what keeps values in registers; large functions called from many places
  // would multiply the code, and the compiler's time, though.
  void choose_inlined() {
    constexpr std::size_t kLargestInlined = 800;  // instructions, those of inlined callees included
    constexpr std::size_t kMostCopies = 2000;     // instructions of all copies together
    std::map<const Instance*, std::size_t> size, call_sites;
    for (const Instance* i : instances_.callees_first)
      for (const auto& [call, callee] : i->callees) ++call_sites[callee];
    for (Instance* i : instances_.callees_first) {
      std::size_t& own = size[i];
      for_each_statement(i->info->body.list, [&](const Statement& s) { own += s.code.size() + 1; });
      for (const auto& [call, callee] : i->callees) own += callee->inlined ? size[callee] : 1;
      i->inlined = call_sites[i] <= 1 || (own <= kLargestInlined && own * call_sites[i] <= kMostCopies);
    }
  }

  // Uniform arrays that some function indexes by a varying value, to be kept as tables.
  void find_varying_indices() {
    for (const Instance* at : instances_.callees_first)
      for_each_instruction(at->info->body.list, [&](const Instruction& i) {
        if (i.is_chain() && at->is_varying(i.operands[1])) indexed_by_lanes_.insert(i.operands[0]);
      });
  }

  bool is_table(Id array) const {
    const Type& t = module_.type(array);
    if (t.kind != Kind::array) return false;
    const Kind element = module_.type(t.element).kind;
    const Kind scalar = module_.scalar_kind(t.element);
    return (element == Kind::vector || element == scalar) && scalar != Kind::boolean && element != Kind::structure;
  }

  std::string table_type(Id array) {
    const Type& t = module_.type(array);
    return "table<" + types_.name(t.element, false) + ", " + std::to_string(t.count) + ">";
  }

  // The author's name of a const array: SPIR-V has lost it, the line that indexes it has not.
  std::string table_name(const FunctionInfo& info, Id variable) const {
    static const std::regex declared(R"(\bconst\s+\w+\s*(?:\[[^\]]*\]\s*)*(\w+)\s*[\[=])");
    std::set<std::string> constants;
    std::smatch match;
    for (std::string text = source_.text; std::regex_search(text, match, declared); text = match.suffix())
      constants.insert(match[1]);
    std::set<std::string> candidates;
    for_each_instruction(info.body.list, [&](const Instruction& i) {
      if (i.op != spv::OpStore || i.operands[0] != variable) return;
      const Position p = module_.position(i);
      static const std::regex indexed(R"((\w+)\s*\[)");
      for (std::string text = lines_.text(p.file, p.line); std::regex_search(text, match, indexed);
           text = match.suffix())
        if (constants.count(match[1])) candidates.insert(match[1]);
    });
    return candidates.size() == 1 ? *candidates.begin() : "constants";
  }

  void constant_tables() {
    std::map<Id, std::string> by_constant;
    for (Id function : program_.callees_first) {
      const FunctionInfo& info = program_.info(function);
      for (const auto& [variable, constant] : info.constant_tables) {
        std::string& name = by_constant[constant];
        if (name.empty()) {
          name = names_.declare(table_name(info, variable));
          const Id type = module_.constants.at(constant).type;
          if (is_table(type)) {
            shared_.out.line("static constexpr " + table_type(type) + " " + name + "{" + types_.constant(constant) +
                             "};");
          } else {
            shared_.out.line("static constexpr " + types_.name(type, false) + " " + name + " = " +
                             types_.constant(constant) + ";");
          }
        }
        shared_.tables[{function, variable}] = name;
      }
    }
  }

  void write_members() {
    Writer& out = shared_.out;
    out.line("");
    for (Id id : module_.globals) {
      const auto found = interface_.globals.find(id);
      if (found == interface_.globals.end() || !found->second.mentioned) continue;
      const Global& g = found->second;
      switch (g.role) {
        case Role::input:
          write_input(g);
          break;
        case Role::output:
        case Role::frag_depth:
          out.line(types_.name(g.type, true) + " " + g.name + ";");
          if (!is_written_first(program_, id)) reset_ += "    " + g.name + " = " + types_.name(g.type, true) + "{};\n";
          break;
        case Role::global: {
          const std::string type = types_.name(g.type, instances_.varying_globals.count(id) != 0);
          const Id initializer = module_.variables.at(id).initializer;
          out.line(type + " " + g.name + ";");
          if (initializer != 0 || !is_written_first(program_, id))
            reset_ += "    " + g.name + " = " + (initializer != 0 ? types_.constant(initializer) : type + "{}") + ";\n";
          break;
        }
        case Role::uniform:
          if (indexed_by_lanes_.count(id) && is_table(g.type)) {
            out.line(table_type(g.type) + " " + g.name + "{" + types_.name(g.type, false) + "{}};");
          } else {
            out.line(types_.name(g.type, false) + " " + g.name + ";");
          }
          break;
        case Role::sampler:
          out.line(types_.name(g.type, false) + " " + g.name + ";");
          break;
        case Role::buffer:
        case Role::shared:
          out.line(view_type(g.role == Role::buffer ? g.type : 0) + " " + g.name + ";");
          break;
        case Role::builtin:
          break;
      }
      if (g.role == Role::output)
        outputs_ += "    output(" + std::to_string(g.first_component) + ", " + g.name + ");\n";
      if (g.role == Role::frag_depth) outputs_ += "    frag_depth(" + g.name + ");\n";
    }
    if (!shared_.half_lines.empty()) out.line("const std::uint32_t* " + shared_.half_lines + ";");
    write_constructor();
    out.line("");
    out.open("TWINSHADE_FUNCTION void run() {");
    const std::string main = "    main();\n";
    for (const std::string* block : std::initializer_list<const std::string*>{&reset_, &main, &outputs_}) {
      std::string rest = *block;
      for (std::size_t end = rest.find('\n'); end != std::string::npos; end = rest.find('\n')) {
        out.line(rest.substr(rest.find_first_not_of(' '), end - rest.find_first_not_of(' ')));
        rest = rest.substr(end + 1);
      }
    }
    out.close("}");
  }

  // Blocks are views; an array of blocks is an array of views.
  std::string view_type(Id type) const {
    if (type == 0 || module_.type(type).kind != Kind::array) return "BufferView";
    return "arr<" + view_type(module_.type(type).element) + ", " + std::to_string(module_.type(type).count) + ">";
  }

  // Structs, which the runtime knows nothing about, are put together member by member.
  void input_members(Id id, const std::string& target, std::uint32_t& component) {
    const Type& t = module_.type(id);
    if (t.kind == Kind::structure) {
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        input_members(t.members[k], target + "." + types_.member(id, k), component);
      return;
    }
    if (t.kind == Kind::array) {
      for (std::uint32_t k = 0; k < t.count; ++k)
        input_members(t.element, target + "[" + std::to_string(k) + "]", component);
      return;
    }
    shared_.out.line(target + " = this->template input<" + types_.name(id, true) + ">(" + std::to_string(component) +
                     ");");
    component += module_.component_count(id);
  }

  void write_input(const Global& g) {
    const std::string type = types_.name(g.type, true);
    if (module_.type(module_.innermost(g.type)).kind == Kind::structure) {
      shared_.out.open("TWINSHADE_INLINE " + type + " " + g.name + "() const {");
      shared_.out.line(type + " value;");
      std::uint32_t component = g.first_component;
      input_members(g.type, "value", component);
      shared_.out.line("return value;");
      shared_.out.close("}");
      return;
    }
    shared_.out.line(type + " " + g.name + "() const { return this->template input<" + type + ">(" +
                     std::to_string(g.first_component) + "); }");
    const Type& t = module_.type(g.type);
    if (t.kind != Kind::array) return;
    const std::string element = types_.name(t.element, true);
    shared_.out.line(element + " " + g.name + "(auto i) const { return this->template input<" + element + ">(" +
                     std::to_string(g.first_component) + ", " + std::to_string(module_.component_count(t.element)) +
                     ", " + std::to_string(t.count) + ", i); }");
  }

  // Uniforms and small uniform blocks are read once, before all invocations.
  void write_constructor() {
    Writer& out = shared_.out;
    out.line("");
    out.open(
        "TWINSHADE_INLINE Shader(const ShaderData& shader_data, const ShadeCall& shade_call) : Base(shader_data, "
        "shade_call) {");
    bool has_memory = false;
    if (!shared_.half_lines.empty())
      out.line(shared_.half_lines + " = half_switches(this->uniforms(" +
               std::to_string(interface_.reflection.uniform_bytes) + "));");
    for (Id id : module_.globals) {
      const auto found = interface_.globals.find(id);
      if (found == interface_.globals.end() || !found->second.mentioned) continue;
      const Global& g = found->second;
      if (g.role == Role::sampler) {
        const std::string type = types_.name(module_.innermost(g.type), false);
        const std::string function = type == "samplerCube"      ? "texture_cube"
                                     : type == "sampler2DArray" ? "texture_2d_array"
                                                                : "texture_2d";
        std::uint32_t slot = g.slot;
        for (const std::string& suffix : module_.element_suffixes(g.type))
          out.line(g.name + suffix + " = this->" + function + "(" + std::to_string(slot++) + ");");
      } else if (g.role == Role::buffer) {
        std::uint32_t slot = g.slot;
        for (const std::string& suffix : module_.element_suffixes(g.type))
          out.line(g.name + suffix + " = this->buffer(" + std::to_string(slot++) + ");");
      } else if (g.role == Role::shared) {
        out.line(g.name + " = this->shared(" + std::to_string(g.offset) + ", " +
                 std::to_string(Layout(module_, false).size(g.type)) + ");");
      } else if (g.role == Role::uniform) {
        std::string memory = "memory";
        if (g.in_block)
          memory = "this->buffer(" + std::to_string(g.slot) + ")";
        else if (!has_memory)
          out.line("const BufferView memory = this->uniforms(" + std::to_string(interface_.reflection.uniform_bytes) +
                   ");"),
              has_memory = true;
        if (indexed_by_lanes_.count(id) && is_table(g.type)) {
          const std::string local = g.name + "_values";
          out.open("{");
          out.line(types_.name(g.type, false) + " " + local + ";");
          load_uniform(Layout(module_, g.in_block), memory, g.type, local, g.offset, "", {}, 0);
          out.line(g.name + " = " + table_type(g.type) + "(" + local + ");");
          out.close("}");
        } else {
          // The loops over arrays count with i, i1 ...: a uniform of that name is not theirs.
          const bool like_a_counter = std::regex_match(g.name, std::regex("i[0-9]*"));
          load_uniform(Layout(module_, g.in_block), memory, g.type, (like_a_counter ? "this->" : "") + g.name, g.offset,
                       "", {}, 0);
        }
      }
    }
    out.close("}");
  }

  // Reads what lies `offset` bytes plus `dynamic` (made of loop counters) into `memory`.
  void load_uniform(const Layout& layout, const std::string& memory, Id id, const std::string& target,
                    std::uint32_t offset, const std::string& dynamic, const MatrixLayout& matrix, int depth) {
    const Type& t = module_.type(id);
    Writer& out = shared_.out;
    switch (t.kind) {
      case Kind::structure:
        for (std::uint32_t k = 0; k < t.members.size(); ++k)
          load_uniform(layout, memory, t.members[k], target + "." + types_.member(id, k),
                       offset + layout.member_offset(id, k), dynamic, layout.member_matrix(id, k), depth);
        return;
      case Kind::array: {
        const std::string i = depth == 0 ? "i" : "i" + std::to_string(depth);
        out.open("for (int " + i + " = 0; " + i + " < " + std::to_string(t.count) + "; ++" + i + ") {");
        load_uniform(layout, memory, t.element, target + "[" + i + "]", offset,
                     dynamic + " + " + std::to_string(layout.array_stride(id)) + " * " + i, matrix, depth + 1);
        out.close("}");
        return;
      }
      case Kind::matrix:
        for (std::uint32_t c = 0; c < t.count; ++c) {
          const std::string column = target + "[" + std::to_string(c) + "]";
          if (!matrix.row_major) {
            load_uniform(layout, memory, t.element, column, offset + c * matrix.stride, dynamic, matrix, depth);
            continue;
          }
          const Type& vector = module_.type(t.element);
          for (std::uint32_t r = 0; r < vector.count; ++r)
            load_uniform(layout, memory, vector.element, column + "[" + std::to_string(r) + "]",
                         offset + 4 * c + r * matrix.stride, dynamic, {}, depth);
        }
        return;
      default:
        out.line(target + " = load<" + types_.name(id, false) + ">(" + memory + ", UI(" + std::to_string(offset) +
                 dynamic + "));");
    }
  }

  // Instances that run in float64: all that main reaches but through functions that the runtime serves in double.
  void reach_in_double(const Instance& at, std::set<const Instance*>& reached) const {
    if (is_served_in_double(module_, *at.info->function) || !reached.insert(&at).second) return;
    for (const auto& [call, callee] : at.callees) reach_in_double(*callee, reached);
  }

  void write_functions() {
    std::set<const Instance*> in_double;
    reach_in_double(*instances_.main, in_double);
    std::vector<const Instance*> order(instances_.callees_first.begin(), instances_.callees_first.end());
    const auto place = [&](const Instance* i) {
      return lines_.order(module_.position(i->info->function->file, i->info->function->line));
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const Instance* a, const Instance* b) { return place(a) < place(b); });
    for (const Instance* i : order) {
      shared_.out.line("");
      FunctionEmitter(shared_, *i, in_double.count(i) != 0).run();
    }
  }

  // Behind the shader's own uniforms. Which lines there are is known once its functions are written.
  void reflect_half_lines() {
    if (shared_.switched.empty()) return;
    Reflection& reflection = interface_.reflection;
    for (const Position& line : shared_.switched) reflection.half_lines.emplace_back(line.file, line.line);
    ReflectedUniform switches;
    switches.name = kHalfLines;
    switches.scalar = Scalar::u32;
    switches.array_length = std::uint32_t(shared_.switched.size());
    switches.offset = reflection.uniform_bytes;
    switches.array_stride = 4;
    reflection.uniforms.push_back(switches);
    reflection.uniform_bytes += 4 * switches.array_length;
  }

  std::string head() const {
    return "// " + source_.name + ": translated from " +
                       (source_.files.empty() ? source_.name : source_.files[0]) +
                       " by twinshade. docs/generated-code.md says how to read it.\n"
                       "#include \"cpu_shaders/runtime/runtime.h\"\n" +
                       (source_.precision == Precision::full ? "" : std::string(kHalfInclude)) + "\n"
                       "#pragma GCC diagnostic ignored \"-Wunused-parameter\"\n"
                       "#pragma GCC diagnostic ignored \"-Wunused-variable\"\n"
                       "#pragma GCC diagnostic ignored \"-Wunused-but-set-variable\"\n"
                       "#pragma GCC diagnostic ignored \"-Wunused-but-set-parameter\"\n"
                       "#pragma GCC diagnostic ignored \"-Wunused-function\"\n"
                       "#pragma GCC diagnostic ignored \"-Wshadow\"\n"
                       "#ifdef __clang__\n"
                       "#pragma clang diagnostic ignored \"-Wself-assign-overloaded\"\n"
                       "#endif\n\n"
                       "namespace twinshade {\ninline namespace TWINSHADE_ISA_NAMESPACE {\nnamespace shader_" +
                       translation_.identifier + " {\nnamespace {\n\n";
  }

  static std::string class_head() {
    std::string text = "template <class N>\nstruct Shader : ShaderBase<N> {\n  using Base = ShaderBase<N>;\n";
    for (const char* name : {"kept", "live", "frag_coord", "front_facing", "primitive_id", "frag_depth", "output"})
      text += std::string("  using Base::") + name + ";\n";
    return text;
  }

  const Program& program_;
  const Module& module_;
  Interface& interface_;
  const SourceLines& lines_;
  NameTable& names_;
  const ShaderSource& source_;
  const TranslateOptions& options_;
  Translation& translation_;
  Instances instances_;
  TypeNames types_;
  Emission shared_;
  std::set<Id> indexed_by_lanes_;
  std::string reset_, outputs_;
};

}  // namespace

void emit_module(const Program& program, Interface& interface, const SourceLines& lines, NameTable& names,
                 const ShaderSource& source, const TranslateOptions& options, Translation& translation) {
  ModuleEmitter(program, interface, lines, names, source, options, translation).run();
}

}  // namespace twinshade::spirv
