// Expressions. None has side effects: those are statements of their own (generator_statements.cpp).
#include <algorithm>

#include "tests/fuzz/generator.h"

namespace twinshade::fuzz {

Scalar Generator::base() {
  const Scalar all[] = {Scalar::i32, Scalar::u32, Scalar::f32, Scalar::boolean, Scalar::i32, Scalar::u32};
  return all[below(6)];
}

GlslType Generator::plain_type() {
  const Scalar scalar = base();
  return plain(scalar, allowed(0) && chance(50) ? 2 + below(3) : 1);
}

GlslType Generator::any_type() {
  const int c = below(100);
  GlslType type = plain_type();
  if (allowed(1) && c < 10 && !structures_.empty())
    type = {Scalar::i32, 1, 1, below(static_cast<int>(structures_.size())), {}};
  else if (allowed(2) && c < 18)
    type = {Scalar::f32, 2 + below(3), 2 + below(3), -1, {}};
  if (allowed(3) && chance(20)) {
    type.dimensions.push_back(1 + below(4));
    if (allowed(4) && chance(35)) type.dimensions.push_back(1 + below(3));
  }
  return type;
}

std::string Generator::index(int length) {
  const std::string constant = std::to_string(below(length));
  if (!allowed(5) || chance(45)) return constant;
  std::vector<std::string> candidates;
  for (const Variable& v : scope_)
    if (v.type == plain(Scalar::u32))
      candidates.push_back(v.name);
    else if (v.type == plain(Scalar::i32))
      candidates.push_back("uint(" + v.name + ")");
  if (candidates.empty()) return constant;
  const std::string& chosen = pick(candidates);
  if ((length & (length - 1)) == 0 && chance(50)) return chosen + " & " + std::to_string(length - 1) + "u";
  return chosen + " % " + std::to_string(length) + "u";
}

std::string Generator::swizzle(const std::string& text, int from, int to, bool distinct) {
  std::vector<int> order = {0, 1, 2, 3};
  order.resize(static_cast<std::size_t>(from));
  for (std::size_t k = order.size(); k-- > 1;) std::swap(order[k], order[static_cast<std::size_t>(below(int(k) + 1))]);
  const std::string letters = pick({"xyzw", "rgba", "stpq"});
  std::string picked = text + ".";
  for (int k = 0; k < to; ++k)
    picked += letters[static_cast<std::size_t>(distinct ? order[static_cast<std::size_t>(k)] : below(from))];
  return picked;
}

// Places of type `wanted` within the place `text` of type `type`.
void Generator::places(const std::string& text, const GlslType& type, const GlslType& wanted, bool to_write,
                       std::vector<std::string>& found) {
  if (type == wanted) found.push_back(text);
  if (type.is_array() || type.is_matrix()) {
    const int length = type.is_array() ? type.dimensions[0] : type.columns;
    places(text + "[" + index(length) + "]", type.element(), wanted, to_write, found);
  } else if (type.structure >= 0) {
    for (const Member& m : structures_[static_cast<std::size_t>(type.structure)].members)
      places(text + "." + m.name, m.type, wanted, to_write, found);
  } else if (wanted.is_plain() && wanted.base == type.base && type.rows > 1) {
    if (wanted.rows == 1) {
      // `precise` does not reach a store to a component chosen while running.
      const bool constant = to_write && type.base == Scalar::f32;
      found.push_back(chance(50) ? swizzle(text, type.rows, 1, true)
                                 : text + "[" + (constant ? std::to_string(below(type.rows)) : index(type.rows)) + "]");
    } else if (!to_write || wanted.rows <= type.rows) {
      found.push_back(swizzle(text, type.rows, wanted.rows, to_write));
    }
  }
}

std::vector<std::string> Generator::all_places(const GlslType& wanted, bool to_write) {
  std::vector<std::string> found;
  for (std::size_t k = 0; k < scope_.size(); ++k) {
    const Variable& v = scope_[k];
    const auto hides = [&](const Variable& later) { return later.name == v.name; };
    if (std::any_of(scope_.begin() + static_cast<std::ptrdiff_t>(k) + 1, scope_.end(), hides)) continue;
    if (!to_write || v.writable) places(v.name, v.type, wanted, to_write, found);
  }
  return found;
}

std::string Generator::literal(Scalar base) {
  switch (base) {
    case Scalar::i32:
      return chance(80) ? std::to_string(below(17) - 5) : pick({"2147483647", "-2147483647", "65535", "-1000003"});
    case Scalar::u32:
      return chance(80) ? std::to_string(below(17)) + "u" : pick({"4294967295u", "0x80000000u", "2654435761u"});
    case Scalar::boolean:
      return pick({"true", "false"});
    default:
      return pick(
          {"0.5", "2.0", "1.5", "0.25", "-3.0", "7.0", "0.333333343", "3.14159274", "-0.75", "1024.0", "0.100000001"});
  }
}

std::string Generator::constant(const GlslType& type) {
  if (type.rows == 1) return literal(type.base);
  std::string text = name_of(type) + "(" + literal(type.base);
  if (chance(60))
    for (int k = 1; k < type.rows; ++k) text += ", " + literal(type.base);
  return text + ")";
}

std::string Generator::leaf(const GlslType& type) {
  const bool real = type.base == Scalar::f32;
  const std::vector<std::string> found = all_places(type, false);
  if (!found.empty() && (real || chance(70))) return pick(found);
  if (!real) return constant(type);
  // A float is never made of constants alone: what a compiler knows to be 0 it folds without regard to signs.
  std::string text = name_of(type) + "(" + leaf(plain(Scalar::f32));
  for (int k = 1; k < type.rows; ++k) text += ", " + leaf(plain(Scalar::f32));
  return text + ")";
}

std::string Generator::value(const GlslType& type, int depth) {
  if (!type.is_plain()) return composite(type, depth);
  if (type.base == Scalar::f32) return depth > 0 && may_hoist_ ? held(real(type, depth), type) : leaf(type);
  if (type.base == Scalar::boolean) return type.rows == 1 ? truth(depth) : truths(type.rows, depth);
  return integer(type, depth);
}

// A precise variable, declared before the statement that is being written.
std::string Generator::held(const std::string& text, const GlslType& type) {
  const std::string name = fresh();
  line("precise " + name_of(type) + " " + name + " = " + text + ";");
  scope_.push_back({name, type, true, true});
  return name;
}

// A float that is neither NaN nor out of the range of int.
std::string Generator::tame(int rows, bool narrow) {
  const std::string bound = narrow ? "1000.0" : "1048576.0";
  return held("clamp(" + leaf(plain(Scalar::f32, rows)) + ", -" + bound + ", " + bound + ")", plain(Scalar::f32, rows));
}

std::string Generator::pure_call(const GlslType& type, int depth) {
  std::vector<const Function*> fit;
  for (const Function& f : functions_)
    if (f.pure && f.returns_value && f.result == type && affordable(f)) fit.push_back(&f);
  if (fit.empty()) return leaf(type);
  const Function& f = *pick(fit);
  cost_ += times_ * f.cost;
  std::string text = f.name + "(";
  for (const Parameter& p : f.parameters) text += (text.back() == '(' ? "" : ", ") + value(p.type, depth - 1);
  return text + ")";
}

std::string Generator::integer(const GlslType& type, int depth) {
  if (depth <= 0) return leaf(type);
  const int c = below(100), d = depth - 1;
  const bool is_signed = type.base == Scalar::i32;
  if (c < 20) return leaf(type);
  if (c < 48) {
    const bool mixed = type.rows > 1 && chance(25);  // vector and scalar
    return join({"(", integer(type, d), pick({" + ", " - ", " * ", " & ", " | ", " ^ "}),
                 integer(mixed ? plain(type.base) : type, d), ")"});
  }
  if (c < 55) {
    const GlslType count = plain(chance(50) ? type.base : Scalar::u32, type.rows);
    return join({"(", integer(type, d), pick({" << (", " >> ("}), integer(count, d), " & ",
                 count.base == Scalar::u32 ? "31u" : "31", "))"});
  }
  if (c < 60) return join({is_signed ? pick({"-", "~"}) : "~", "(", integer(type, d), ")"});
  if (c < 66) return divided(type, d);
  if (c < 74) return join({"(", truth(d), " ? ", integer(type, d), " : ", integer(type, d), ")"});
  if (c < 84) return converted(type, d);
  if (c < 92 && allowed(6)) return integer_function(type, d);
  if (c < 96 && allowed(7)) return pure_call(type, d);
  if (type.rows > 1) {
    std::string text = name_of(type) + "(" + integer(plain(type.base), d);
    for (int k = 1; k < type.rows; ++k) text += ", " + integer(plain(type.base), d);
    return text + ")";
  }
  return swizzle(integer(plain(type.base, 2 + below(3)), d), 2, 1, true);
}

// Quotients and remainders are of uints: other divisors may be 0 or -1, and `%` of negative ints means nothing.
std::string Generator::divided(const GlslType& type, int depth) {
  const GlslType u = plain(Scalar::u32, type.rows);
  const std::string text =
      join({"(", integer(u, depth), pick({" / (", " % ("}), integer(u, depth), pick({" | 1u", " | 7u"}), "))"});
  return type.base == Scalar::u32 ? text : name_of(type) + text;
}

std::string Generator::converted(const GlslType& type, int depth) {
  const std::string constructor = name_of(type);
  switch (below(4)) {
    case 0:
      return constructor + "(" + (type.rows == 1 ? truth(depth) : truths(type.rows, depth)) + ")";
    case 1:
      if (may_hoist_ && allowed(8)) {
        const std::string t = tame(type.rows, true);
        return type.base == Scalar::u32 ? constructor + "(abs(" + t + "))" : constructor + "(" + t + ")";
      }
      [[fallthrough]];
    case 2:
      if (may_hoist_ && allowed(9))
        return (type.base == Scalar::i32 ? "floatBitsToInt(" : "floatBitsToUint(") + tame(type.rows, false) + ")";
      [[fallthrough]];
    default:
      return constructor + "(" +
             integer(plain(type.base == Scalar::i32 ? Scalar::u32 : Scalar::i32, type.rows), depth) + ")";
  }
}

std::string Generator::integer_function(const GlslType& type, int depth) {
  const std::string a = integer(type, depth);
  const std::string suffix = type.base == Scalar::u32 ? "u" : "";
  switch (below(9)) {
    case 0:
      return join({pick({"min(", "max("}), a, ", ", integer(type, depth), ")"});
    case 1:
      return "clamp(" + a + ", " + (suffix.empty() ? "-9" : "3u") + ", 100" + suffix + ")";
    case 2:
      return join({"bitfieldExtract(", a, ", ", std::to_string(below(17)), ", ", std::to_string(below(16)), ")"});
    case 3:
      return join({"bitfieldInsert(", a, ", ", integer(type, depth), ", ", std::to_string(below(17)), ", ",
                   std::to_string(below(16)), ")"});
    case 4:
      return "bitfieldReverse(" + a + ")";
    case 5:
      return name_of(type) + "(bitCount(" + a + "))";
    case 6:
      return name_of(type) + "(" + pick({"findLSB", "findMSB"}) + "(" + a + "))";
    case 7:
      if (type.rows > 1) return join({"mix(", a, ", ", integer(type, depth), ", ", truths(type.rows, depth), ")"});
      [[fallthrough]];
    default:
      return type.base == Scalar::i32 ? pick({"abs", "sign"}) + "(" + a + ")" : "max(" + a + ", 2u)";
  }
}

// A comparison of scalars. Floats are compared as variables, without NaN: drivers turn !(a < b) into a >= b.
std::string Generator::comparison(int depth) {
  const std::string op = pick({"<", "<=", ">", ">=", "==", "!="});
  if (chance(35) && may_hoist_) {
    const std::string a = tame(1, false), b = tame(1, false);
    return "(" + a + " " + op + " " + b + ")";
  }
  const GlslType type = plain(chance(50) ? Scalar::i32 : Scalar::u32);
  const std::string u = type.base == Scalar::i32 ? "" : "u";
  if (chance(50)) return join({"((", integer(type, depth), " & 3", u, ") ", op, " ", std::to_string(below(4)), u, ")"});
  return join({"(", integer(type, depth), " ", op, " ", integer(type, depth), ")"});
}

std::string Generator::truth(int depth) {
  if (depth <= 0) return chance(60) ? leaf(plain(Scalar::boolean)) : comparison(0);
  const int c = below(100), d = depth - 1;
  if (c < 45) return comparison(d);
  if (c < 65) return join({"(", truth(d), pick({" && ", " || ", " ^^ "}), truth(d), ")"});
  if (c < 72) return "!" + truth(d);
  if (c < 80 && allowed(0)) return join({pick({"any(", "all("}), truths(2 + below(3), d), ")"});
  if (c < 86 && allowed(7)) return pure_call(plain(Scalar::boolean), d);
  if (c < 89) return "bool(" + integer(plain(Scalar::u32), d) + " & 1u)";
  if (c < 92) return "bool(" + integer(plain(Scalar::i32), d) + ")";
  if (c < 97) {  // whole vectors, structs, arrays
    const GlslType type = any_type();
    if (!holds_float(type, structures_) && !(type.is_array() && type.base == Scalar::boolean)) {
      const std::vector<std::string> found = all_places(type, false);
      if (found.size() > 1) return join({"(", pick(found), pick({" == ", " != "}), pick(found), ")"});
    }
  }
  return leaf(plain(Scalar::boolean));
}

std::string Generator::truths(int rows, int depth) {
  const GlslType type = plain(Scalar::boolean, rows);
  if (depth <= 0) return leaf(type);
  const int c = below(100), d = depth - 1;
  if (c < 50) {
    const std::string function =
        pick({"lessThan", "lessThanEqual", "greaterThan", "greaterThanEqual", "equal", "notEqual"});
    if (chance(30) && may_hoist_) {
      const std::string a = tame(rows, false), b = tame(rows, false);
      return function + "(" + a + ", " + b + ")";
    }
    const GlslType compared = plain(chance(50) ? Scalar::i32 : Scalar::u32, rows);
    return join({function, "(", integer(compared, d), ", ", integer(compared, d), ")"});
  }
  if (c < 60) return "not(" + truths(rows, d) + ")";
  if (c < 75) {
    std::string text = name_of(type) + "(" + truth(d);
    for (int k = 1; k < rows; ++k) text += ", " + truth(d);
    return text + ")";
  }
  if (c < 85) return name_of(type) + "(" + integer(plain(chance(50) ? Scalar::u32 : Scalar::i32, rows), d) + ")";
  return leaf(type);
}

// Arithmetic for the right side of one precise variable. Every operator has an operand that is not known while
// compiling.
std::string Generator::real(const GlslType& type, int depth) {
  if (depth <= 0) return leaf(type);
  const int c = below(100), d = depth - 1;
  if (c < 10) return leaf(type);
  if (c < 50) {
    const std::string op = pick({" + ", " - ", " * ", " * ", " + ", " / "});
    const std::string one = real(type, d);
    const std::string other =
        chance(25) ? literal(Scalar::f32) : real(type.rows > 1 && chance(25) ? plain(Scalar::f32) : type, d);
    return chance(30) ? join({"(", other, op, one, ")"}) : join({"(", one, op, other, ")"});
  }
  if (c < 56) return "-(" + real(type, d) + ")";
  if (c < 62) return "sqrt(abs(" + real(type, d) + "))";
  if (c < 72) return join({pick({"abs(", "floor(", "ceil(", "trunc("}), real(type, d), ")"});
  if (c < 78) {
    // Of x and -x drivers make -abs(x): the second is neither.
    const std::string one = real(type, d), other = literal(Scalar::f32);
    return join(
        {pick({"min(", "max("}), one, ", ", chance(40) ? other : join({"(", real(type, d), " + ", other, ")"}), ")"});
  }
  if (c < 82) return "clamp(" + real(type, d) + ", -2.0, 3.0)";
  if (c < 85) return join({"step(", literal(Scalar::f32), ", ", tame(type.rows, false), ")"});
  if (c < 91) return join({"(", truth(d), " ? ", real(type, d), " : ", real(type, d), ")"});
  if (c < 96) {  // odd: never zero
    const bool is_signed = chance(50);
    return name_of(type) + "((" + integer(plain(is_signed ? Scalar::i32 : Scalar::u32, type.rows), d) +
           (is_signed ? " ^ in_i) | 1)" : " ^ in_u) | 1u)");
  }
  return allowed(7) ? pure_call(type, d) : leaf(type);
}

std::string Generator::maker(const GlslType& type) {
  std::string name = "make_" + structures_[static_cast<std::size_t>(type.structure)].name;
  for (const int length : type.dimensions) name += "_" + std::to_string(length);
  std::string& text = makers_[name];
  if (!text.empty()) return name;
  std::string body = name_of(type) + " made;";
  for (int k = 0; k < type.dimensions[0]; ++k) {
    const std::string at = std::to_string(k);
    text += (text.empty() ? "" : ", ") + name_of(type.element()) + " a" + at;
    body += " made[" + at + "] = a" + at + ";";
  }
  text = name_of(type) + " " + name + "(" + text + ") { " + body + " return made; }\n";
  return name;
}

// Structs, arrays and matrices: a variable, or a constructor.
std::string Generator::composite(const GlslType& type, int depth) {
  const std::vector<std::string> found = all_places(type, false);
  if (!found.empty() && chance(50)) return pick(found);
  std::vector<GlslType> parts;
  if (type.is_array() || type.is_matrix())
    parts.assign(static_cast<std::size_t>(type.is_array() ? type.dimensions[0] : type.columns), type.element());
  else
    for (const Member& m : structures_[static_cast<std::size_t>(type.structure)].members) parts.push_back(m.type);
  // glslang 12 crashes where a precise variable reads such an array's elements, if a constructor made it
  // (docs/hardening.md): a function does.
  const bool crashes = type.is_array() && type.structure >= 0 && holds_float(type, structures_);
  std::string text = (crashes ? maker(type) : name_of(type)) + "(";
  for (const GlslType& part : parts) text += (text.back() == '(' ? "" : ", ") + value(part, std::min(depth - 1, 1));
  return text + ")";
}

}  // namespace twinshade::fuzz
