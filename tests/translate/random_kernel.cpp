// Writes a random kernel (see kernels/README.md): nested control flow of every kind over unsigned integers, functions
// with in, out and inout parameters, arrays, structs, a global. Every loop is bounded, every index masked.
//   random_kernel SEED OUT.glsl
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace {

using Names = std::vector<std::string>;

struct Function {
  std::string name;
  bool returns_value = true, has_reference = false;
};

// What a statement may read and write.
struct Scope {
  Names values, writable, arrays, counters, structs;  // counters: the same in all invocations
};

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::string kernel() {
    text_ = "struct S { uint a; uint b; uint t[2]; };\nuint g = 1u;\n";
    for (int k = 0; k < 5; ++k) function("f" + std::to_string(k));
    text_ +=
        "ivec4 kernel(int a, int b, float x, float y) {\n  uint r0 = uint(a), r1 = uint(b), r2 = uint(x * 2.0f), r3 = "
        "0u;\n";
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      const Function& f = functions_[k];
      const std::string call =
          f.name + "(r0 & 7u, " + pick({"r1", "2u", "uint(b)"}) + (f.has_reference ? ", r3)" : ")");
      const std::string result = "r" + std::to_string(k % 3);
      text_ += "  " + (f.returns_value ? result + " = " + result + " * 5u + " + call : call) + ";\n";
    }
    return text_ + "  return ivec4(int(r0), int(r1), int(r2 ^ r3), int(g));\n}\n";
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> all) {
    return *(all.begin() + below(static_cast<int>(all.size())));
  }
  const std::string& pick(const Names& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  std::string fresh() { return "v" + std::to_string(++variables_); }

  std::string expression(const Scope& s, int depth = 0) {
    const int c = below(100);
    if (depth > 2 || c < 45) return chance(75) ? pick(s.values) : std::to_string(below(10)) + "u";
    if (c < 55 && !s.arrays.empty()) return pick(s.arrays) + "[(" + expression(s, depth + 1) + ") & 3u]";
    if (c < 62)
      return "(" + condition(s, depth + 1) + " ? " + expression(s, depth + 1) + " : " + expression(s, depth + 1) + ")";
    if (c < 68) return "((" + expression(s, depth + 1) + " >> 1u) + " + expression(s, depth + 1) + ")";
    return "(" + expression(s, depth + 1) + " " + pick({"+", "-", "*", "^", "&", "|"}) + " " +
           expression(s, depth + 1) + ")";
  }

  std::string condition(const Scope& s, int depth = 0) {
    const int c = below(100);
    const std::string number = std::to_string(below(5)) + "u)";
    if (c < 20 && depth < 2)
      return "(" + condition(s, depth + 1) + " " + pick({"&&", "||"}) + " " + condition(s, depth + 1) + ")";
    if (c < 35 && !s.counters.empty()) return "(" + pick(s.counters) + " " + pick({"<", "==", ">"}) + " " + number;
    return "((" + expression(s, depth + 1) + " & " + pick({"1u", "3u", "7u"}) + ") " + pick({"<", "==", ">", "!="}) +
           " " + number;
  }

  void line(const std::string& code) { text_ += std::string(static_cast<std::size_t>(2 * indent_), ' ') + code + "\n"; }

  void block(Scope s, int depth, bool in_loop, bool in_switch) {
    ++indent_;
    for (int k = 1 + below(4); k > 0; --k) statement(s, depth, in_loop, in_switch);
    --indent_;
  }

  void statement(Scope& s, int depth, bool in_loop, bool in_switch) {
    const int c = below(100);
    if (c < 15) {
      const std::string v = fresh();
      line("uint " + v + " = " + expression(s) + ";");
      s.values.push_back(v), s.writable.push_back(v);
    } else if (c < 20) {
      const std::string v = fresh();
      line("uint " + v + "[4];");
      line("for (int z = 0; z < 4; z++) " + v + "[z] = " + expression(s) + " + uint(z);");
      s.arrays.push_back(v);
    } else if (c < 38) {
      line(pick(s.writable) + " " + pick({"=", "+=", "^="}) + " " + expression(s) + ";");
    } else if (c < 44 && !s.arrays.empty()) {
      line(pick(s.arrays) + "[(" + expression(s) + ") & 3u] " + pick({"=", "+="}) + " " + expression(s) + ";");
    } else if (c < 48) {
      line("g = g * 3u + " + expression(s) + ";");
    } else if (c < 52) {
      const std::string v = fresh();
      line("S " + v + "; " + v + ".a = " + expression(s) + "; " + v + ".b = 1u; " + v + ".t[0] = 2u; " + v +
           ".t[1] = 3u;");
      s.structs.push_back(v), s.values.push_back(v + ".a"), s.values.push_back(v + ".t[1]");
    } else if (c < 56 && !s.structs.empty()) {
      const std::string& v = pick(s.structs);
      line(v + "." + pick({"a", "b"}) + " = " + expression(s) + ";");
      line(v + ".t[(" + expression(s) + ") & 1u] += " + v + ".a;");
    } else if (c < 58 && !s.structs.empty()) {
      line(pick(s.structs) + " = " + pick(s.structs) + ";");
    } else if (c < 74 && depth < 4) {
      line("if (" + condition(s) + ") {");
      block(s, depth + 1, in_loop, in_switch);
      if (chance(50)) {
        line("} else {");
        block(s, depth + 1, in_loop, in_switch);
      }
      line("}");
    } else if (c < 85 && depth < 3) {
      loop(s, depth);
    } else if (c < 90 && depth < 3) {
      switch_statement(s, depth, in_loop);
    } else if (c < 94 && (in_loop || in_switch)) {
      line("if (" + condition(s) + ") " + (in_loop && chance(50) ? "continue;" : "break;"));
    } else if (c < 96 && depth > 0) {
      line("if (" + condition(s) + ") return" + (current_.returns_value ? " " + expression(s) + ";" : ";"));
    } else if (!functions_.empty()) {
      const Function f = functions_[static_cast<std::size_t>(below(static_cast<int>(functions_.size())))];
      const std::string call =
          f.name + "(" + expression(s) + ", " + expression(s) + (f.has_reference ? ", " + pick(s.writable) : "") + ");";
      line(f.returns_value ? pick(s.writable) + " " + pick({"=", "+="}) + " " + call : call);
    }
  }

  void loop(Scope& s, int depth) {
    const std::string v = fresh();
    Scope inner = s;
    inner.values.push_back(v);
    switch (below(4)) {
      case 0:
        inner.counters.push_back(v);
        line("for (uint " + v + " = 0u; " + v + " < " + std::to_string(1 + below(5)) + "u; " + v + "++) {");
        block(inner, depth + 1, true, false);
        line("}");
        return;
      case 1:
        line("for (uint " + v + " = 0u; " + v + " < ((" + expression(s) + ") & 3u) + 1u; " + v + " += 1u) {");
        block(inner, depth + 1, true, false);
        line("}");
        return;
      case 2:
        line("uint " + v + " = 0u;");
        line("while (" + v + " < 5u && " + condition(s) + ") {");
        line("  " + v + "++;");
        block(inner, depth + 1, true, false);
        line("}");
        break;
      default:
        line("uint " + v + " = 0u;");
        line("do {");
        line("  " + v + "++;");
        block(inner, depth + 1, true, false);
        line("} while (" + v + " < 4u && " + condition(s) + ");");
    }
    s.values.push_back(v);
  }

  void switch_statement(const Scope& s, int depth, bool in_loop) {
    line("switch (" + (s.counters.empty() || chance(60) ? "(" + expression(s) + ") & 3u" : pick(s.counters)) + ") {");
    std::vector<int> labels = {0, 1, 2, 3, -1};  // -1: default
    std::shuffle(labels.begin(), labels.end(), random_);
    labels.resize(static_cast<std::size_t>(1 + below(5)));
    for (std::size_t k = 0; k < labels.size(); ++k) {
      line((labels[k] < 0 ? std::string("  default") : "  case " + std::to_string(labels[k]) + "u") + ": {");
      ++indent_;
      block(s, depth + 1, in_loop, true);
      --indent_;
      line(chance(50) || k + 1 == labels.size() ? "  } break;" : "  }");
    }
    line("}");
  }

  void function(const std::string& name) {
    current_ = {name, chance(75), chance(60)};
    const bool out = chance(50);
    text_ += (current_.returns_value ? "uint " : "void ") + name + "(uint p0, uint p1" +
             (current_.has_reference ? (out ? ", OUT(uint) q0" : ", INOUT(uint) q0") : "") + ") {\n";
    Scope s{{"p0", "p1"}, {"p0"}, {}, {}, {}};
    indent_ = 1;
    if (current_.has_reference) {
      if (out) line("q0 = 1u;");
      s.values.push_back("q0"), s.writable.push_back("q0");
    }
    const std::size_t start = text_.size();
    while (text_.size() < start + 400) statement(s, 0, false, false);
    if (current_.returns_value) line("return " + pick({"p0 + 1u", "g", "p0 ^ p1"}) + ";");
    text_ += "}\n";
    functions_.push_back(current_);
  }

  std::mt19937 random_;
  std::string text_;
  std::vector<Function> functions_;
  Function current_;
  int indent_ = 0, variables_ = 0;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  std::ofstream(arguments[2]) << Generator(static_cast<unsigned>(std::atoi(arguments[1]))).kernel();
  return 0;
}
