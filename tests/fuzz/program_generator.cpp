#include "tests/fuzz/program_generator.h"

#include <algorithm>
#include <bit>

#include "tests/fuzz/generator.h"

namespace twinshade::fuzz {

Generator::Generator(std::uint64_t seed) : random_(seed), features_(random_() | random_()) {
  // Some prefixes make names that the translator or C++ use themselves, or that look like macros.
  prefix_ = pick({"v", "value", "mask", "t", "c", "choice", "vec_", "kept", "again", "delete", "M_"});
}

std::string Generator::fresh() { return prefix_ + std::to_string(++names_); }

void Generator::structures() {
  for (int k = allowed(1) ? 1 + below(3) : 0; k > 0; --k) {
    Structure s{"S" + std::to_string(structures_.size()), {}};
    for (int m = 1 + below(4); m > 0; --m) {
      GlslType type = any_type();
      // No bool arrays in comparisons of whole structs: glslang has no code for them.
      if (type.is_array() && type.base == Scalar::boolean) type.base = Scalar::u32;
      s.members.push_back({"m" + std::to_string(m), type});
    }
    structures_.push_back(s);
    text_ += "struct " + s.name + " {\n";
    for (const Member& m : s.members) text_ += std::string("  ") + name_of(m.type) + " " + m.name + ";\n";
    text_ += "};\n";
  }
}

void Generator::interface(GeneratedProgram& program) {
  program.inputs = {{"in_i", plain(Scalar::i32)}, {"in_u", plain(Scalar::u32)}, {"in_f", plain(Scalar::f32)}};
  for (int k = below(4); k > 0; --k) {
    GlslType type = plain_type();
    if (type.base == Scalar::boolean) type.base = Scalar::f32;
    program.inputs.push_back({"in_" + std::to_string(k), type});
  }
  for (int k = below(4); k > 0; --k) {
    GlslType type = plain_type();
    if (chance(30)) type.dimensions = {2 + below(3)};
    program.uniforms.push_back({"u_" + std::to_string(k), type});
  }
  program.outputs = {
      {"out_real", plain(Scalar::f32, 4)}, {"out_int", plain(Scalar::i32, 4)}, {"out_uint", plain(Scalar::u32, 4)}};
  for (const Interface& v : program.inputs) {
    text_ += (v.type.base == Scalar::f32 ? "in " : "flat in ") + name_of(v.type) + " " + v.name + ";\n";
    scope_.push_back({v.name, v.type, false, false});
  }
  for (const Interface& v : program.uniforms) {
    text_ += "uniform " + name_of(v.type) + " " + v.name + ";\n";
    scope_.push_back({v.name, v.type, false, false});
  }
  for (std::size_t k = 0; k < 3; ++k)
    text_ += "layout(location = " + std::to_string(k) + ") out " + name_of(program.outputs[k].type) + " " +
             program.outputs[k].name + ";\n";
  for (int k = allowed(17) ? 1 + below(3) : 0; k > 0; --k) {
    const std::string name = "global_" + std::to_string(k);
    const Scalar base = chance(50) ? Scalar::u32 : Scalar::i32;
    const GlslType type = plain(base, 1 + below(3));
    text_ += name_of(type) + " " + name + " = " + constant(type) + ";\n";
    globals_.push_back(name);
    scope_.push_back({name, type, true, false});
  }
  if (allowed(18)) {  // a table
    text_ += "const int table[5] = int[](3, -1, 4, 1, -5);\n";
    scope_.push_back({"table", {Scalar::i32, 1, 1, -1, {5}}, false, false});
  }
}

void Generator::function() {
  current_ = Function{};
  current_.name = "f" + std::to_string(functions_.size());
  current_.returns_value = chance(80);
  current_.result = any_type();
  current_.pure = !allowed(17);
  const std::size_t mark = scope_.size();
  // Globals are written only by functions that are not pure: those that see them as writable.
  const bool writes_globals = allowed(17) && chance(50);
  if (!writes_globals) current_.pure = true;
  for (Variable& v : scope_)
    if (std::find(globals_.begin(), globals_.end(), v.name) != globals_.end()) v.writable = writes_globals;
  std::string head =
      (current_.returns_value ? name_of(current_.result) : std::string("void")) + " " + current_.name + "(";
  std::vector<Variable> to_fill;
  for (int k = below(4); k > 0; --k) {
    Parameter p{Direction::in, any_type()};
    if (allowed(19) && chance(40))
      p.direction = chance(50) ? Direction::out : Direction::inout;
    else if (chance(15))
      p.direction = Direction::constant_in;
    const bool out = p.direction == Direction::out || p.direction == Direction::inout;
    if (out) current_.pure = false;
    const char* const directions[] = {"", "const in ", "out ", "inout "};
    const std::string name = fresh();
    head += (head.back() == '(' ? "" : ", ") + std::string(directions[static_cast<int>(p.direction)]) +
            name_of(p.type) + " " + name;
    current_.parameters.push_back(p);
    const Variable v{name, p.type, p.direction != Direction::constant_in, false};
    if (p.direction == Direction::out)
      to_fill.push_back(v);
    else
      scope_.push_back(v);
  }
  text_ += head + ") {\n";
  indent_ = 1, nesting_ = 1, cost_ = 1, times_ = 1;
  for (const Variable& v : to_fill) {
    line(v.name + " = " + value(v.type, 1) + ";");
    scope_.push_back(v);
  }
  statements_left_ = 4 + below(4);
  for (int k = 1 + below(3); k > 0; --k) statement();
  if (current_.returns_value) line("return " + value(current_.result, 2) + ";");
  text_ += "}\n";
  current_.cost = cost_;
  functions_.push_back(current_);
  scope_.resize(mark);
  for (Variable& v : scope_)
    if (std::find(globals_.begin(), globals_.end(), v.name) != globals_.end()) v.writable = true;
}

// Every scalar of every variable goes into a sum, a float by its bits where it is a number; some floats as they are.
void Generator::observe(Scope& scope) {
  line("uint sum = 1u;");
  const auto add = [&](auto& self, const std::string& text, const GlslType& type) -> void {
    if (type.is_array() || type.is_matrix()) {
      const int length = type.is_array() ? type.dimensions[0] : type.columns;
      for (int k = 0; k < length; ++k) self(self, text + "[" + std::to_string(k) + "]", type.element());
    } else if (type.structure >= 0) {
      for (const Member& m : structures_[static_cast<std::size_t>(type.structure)].members)
        self(self, text + "." + m.name, m.type);
    } else if (type.base == Scalar::f32) {
      const std::string name = "seen" + std::to_string(++names_);
      line("precise " + name_of(type) + " " + name + " = clamp(" + text + ", -1.00000002e30, 1.00000002e30);");
      for (int k = 0; k < type.rows; ++k)
        line("sum = sum * 31u + floatBitsToUint(" + name + (type.rows > 1 ? "[" + std::to_string(k) + "]" : "") + ");");
    } else {
      for (int k = 0; k < type.rows; ++k)
        line("sum = sum * 31u + uint(" + text + (type.rows > 1 ? "[" + std::to_string(k) + "]" : "") + ");");
    }
  };
  const std::vector<std::string> reals = all_places(plain(Scalar::f32, 4), false);
  const std::string shown_real = reals.empty() ? leaf(plain(Scalar::f32, 4)) : reals.back();
  const std::string shown_int = integer(plain(Scalar::i32, 4), 1), shown_uint = integer(plain(Scalar::u32, 3), 1);
  for (std::size_t k = 0; k < scope.size(); ++k)
    if (scope[k].writable && std::none_of(scope.begin() + static_cast<std::ptrdiff_t>(k) + 1, scope.end(),
                                          [&](const Variable& v) { return v.name == scope[k].name; }))
      add(add, scope[k].name, scope[k].type);
  line("out_real = " + shown_real + ";");
  line("out_int = " + shown_int + ";");
  line("out_uint = uvec4(sum, " + shown_uint + ");");
}

GeneratedProgram Generator::program() {
  GeneratedProgram program;
  text_ = "#version 450\n";
  structures();
  const std::size_t behind_structures = text_.size();
  interface(program);
  for (int k = allowed(7) || allowed(19) ? 1 + below(2) : 0; k > 0; --k) function();
  text_ += "void main() {\n";
  current_ = Function{};
  current_.returns_value = false;
  in_main_ = true;
  indent_ = 1, nesting_ = 1, cost_ = 1, times_ = 1;
  statements_left_ = 7 + below(8);
  for (int k = 3 + below(4); k > 0; --k) statement();
  Scope scope = scope_;
  observe(scope);
  text_ += "}\n";
  for (const auto& [_, text] : makers_) text_.insert(behind_structures, text);
  program.text = text_;
  return program;
}

GeneratedProgram generate_program(std::uint64_t seed) { return Generator(seed).program(); }

std::vector<std::uint32_t> interface_value(std::uint64_t seed, const Interface& variable, std::uint32_t row) {
  std::uint64_t hash = seed * 0x9e3779b97f4a7c15u + row + 1;
  for (const char c : variable.name) hash = hash * 31 + static_cast<unsigned char>(c);
  std::mt19937_64 random(hash);
  std::vector<std::uint32_t> words;
  std::size_t count = component_count(variable.type, {});
  for (; count > 0; --count) {
    const auto bits = static_cast<std::uint32_t>(random());
    const bool small = random() % 4 != 0;
    if (variable.type.base == Scalar::boolean)
      words.push_back(bits & 1);
    else if (variable.type.base == Scalar::f32)
      // Halves and quarters meet ties and equal values; else a float of 2^-7 to 2^8, either sign.
      words.push_back(std::bit_cast<std::uint32_t>(
          small ? static_cast<float>(static_cast<int>(bits % 33) - 16) * 0.25f
                : std::bit_cast<float>((bits & 0x807fffffu) | (120 + (bits >> 23 & 15)) << 23)));
    else
      words.push_back(small ? (variable.type.base == Scalar::i32 ? bits % 21 - 8 : bits % 13) : bits);
  }
  return words;
}

}  // namespace twinshade::fuzz
