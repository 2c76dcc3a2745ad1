// Statements. What has side effects stands alone, so that no order of evaluation matters.
#include <algorithm>

#include "tests/fuzz/generator.h"

namespace twinshade::fuzz {

void Generator::block(int statements) {
  const std::size_t mark = scope_.size();
  ++indent_, ++nesting_;
  for (int k = 0; k < statements; ++k) statement();
  --indent_, --nesting_;
  scope_.resize(mark);
}

void Generator::statement() {
  cost_ += times_;
  --statements_left_;
  const int c = below(100);
  const bool deep = nesting_ > 3 || statements_left_ <= 0;
  if (c < 22) return declaration();
  if (c < 45) return assignment();
  if (c < 59 && !deep && allowed(10)) return choice();
  if (c < 70 && !deep && allowed(11) && times_ < 60) return loop();
  if (c < 77 && !deep && allowed(12)) return switch_statement();
  if (c < 84 && nesting_ > 1) return leave();
  if (c < 91) return call();
  if (c < 94) return increment();
  if (c < 97 && allowed(13)) return side_effects();
  if (!deep) {
    line("{");
    if (allowed(14) && !scope_.empty()) {  // a variable that hides another
      const std::string hidden = scope_.back().name;
      const GlslType type = plain(Scalar::u32);
      const std::size_t mark = scope_.size();
      line("  uint " + hidden + " = " + value(type, 2) + ";");
      scope_.push_back({hidden, type, true, false});
      block(1 + below(2));
      scope_.resize(mark);
    } else {
      block(1 + below(3));
    }
    line("}");
    return;
  }
  assignment();
}

void Generator::declaration() {
  const GlslType type = any_type();
  const bool real = holds_float(type, structures_);
  if (type == plain(Scalar::f32, type.rows)) {
    held(real ? this->real(type, 3) : "", type);
    return;
  }
  const std::string initial = value(type, 3);
  const std::string name = fresh();
  const std::string qualifier = real ? "precise " : chance(15) ? "const " : "";
  const bool brackets_behind = type.is_array() && chance(30);
  GlslType element = type;
  std::string suffix;
  if (brackets_behind) {
    element.dimensions.clear();
    for (const int length : type.dimensions) suffix += "[" + std::to_string(length) + "]";
  }
  line(qualifier + name_of(element) + " " + name + suffix + " = " + initial + ";");
  scope_.push_back({name, type, qualifier != "const ", false});
}

void Generator::assign_real(const std::string& place, const GlslType& type) {
  line(place + " = " + held(real(type, 3), type) + ";");
}

void Generator::assignment() {
  for (int attempt = 0; attempt < 4; ++attempt) {
    const GlslType type = attempt == 3 ? plain(Scalar::u32) : any_type();
    const std::vector<std::string> found = all_places(type, true);
    if (found.empty()) continue;
    const std::string place = pick(found);
    if (type == plain(Scalar::f32, type.rows)) return assign_real(place, type);
    const std::string assigned = value(type, 3);
    const bool whole = type.is_plain() && (type.base == Scalar::i32 || type.base == Scalar::u32);
    line(place + (whole && chance(40) ? pick({" += ", " -= ", " *= ", " ^= ", " |= ", " &= "}) : " = ") + assigned +
         ";");
    return;
  }
  declaration();
}

void Generator::choice() {
  const std::string condition = truth(3);
  line("if (" + condition + ") {");
  block(1 + below(3));
  if (chance(50)) {
    if (chance(30)) {
      may_hoist_ = false;
      const std::string second = truth(2);
      may_hoist_ = true;
      line("} else if (" + second + ") {");
      block(1 + below(2));
    }
    line("} else {");
    block(1 + below(3));
  }
  line("}");
}

void Generator::loop_body() {
  const bool outer_loop = in_loop_;
  const int outer_switches = switches_;
  in_loop_ = true, switches_ = 0;
  block(1 + below(3));
  in_loop_ = outer_loop, switches_ = outer_switches;
}

void Generator::loop() {
  const int most = 1 + below(5), outer_times = times_;
  const std::string v = fresh(), limit = std::to_string(most);
  const std::size_t mark = scope_.size();
  const int kind = below(8);
  if (kind == 1) {  // as many iterations as the invocation says
    const std::string bound = integer(plain(Scalar::i32), 2);
    line("for (int " + v + " = 0, end_" + v + " = (" + bound + ") & 3; " + v + " < end_" + v + "; ++" + v + ") {");
  } else if (kind == 2) {
    line("for (uint " + v + " = " + limit + "u; " + v + " > 0u; " + v + "--) {");
  } else if (kind < 2) {
    line("for (int " + v + " = 0; " + v + " < " + limit + "; " + v + " += " + pick({"1", "2"}) + ") {");
  } else {
    line("int " + v + " = 0;");
    if (kind >= 5) {  // only a jump ends it
      line(kind == 5 ? "for (;;) {" : kind == 6 ? "while (true) {" : "do {");
      line("  if (++" + v + " > " + limit + ") break;");
    } else {
      may_hoist_ = false;
      line(kind == 3 ? "while (" + v + " < " + limit + " && " + truth(2) + ") {" : "do {");
      may_hoist_ = true;
      line("  " + v + "++;");
    }
  }
  scope_.push_back({v, plain(kind == 2 ? Scalar::u32 : Scalar::i32), false, false});
  times_ *= most + (kind == 1 ? 3 : 0);
  loop_body();
  times_ = outer_times;
  if (kind == 4) {
    may_hoist_ = false;
    line("} while (" + v + " < " + limit + " && " + truth(2) + ");");
    may_hoist_ = true;
  } else {
    line(kind == 7 ? "} while (true);" : "}");
  }
  if (kind < 3) scope_.resize(mark);
}

void Generator::switch_statement() {
  const bool is_signed = chance(50);
  const std::string u = is_signed ? "" : "u";
  line("switch ((" + integer(plain(is_signed ? Scalar::i32 : Scalar::u32), 2) + ") & 3" + u + ") {");
  std::vector<int> labels = {0, 1, 2, 3, -1};  // -1: default
  for (std::size_t k = labels.size(); k-- > 1;)
    std::swap(labels[k], labels[static_cast<std::size_t>(below(static_cast<int>(k) + 1))]);
  labels.resize(static_cast<std::size_t>(1 + below(5)));
  ++switches_;
  ++indent_;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const std::string label = labels[k] < 0 ? "default:" : "case " + std::to_string(labels[k]) + u + ":";
    const bool last = k + 1 == labels.size();
    if (!last && chance(20)) {  // shares the body of the next
      line(label);
      continue;
    }
    line(label + " {");
    block(1 + below(2));
    line(!last && chance(40) ? "}" : "} break;");
  }
  --indent_;
  --switches_;
  line("}");
}

// break, continue, return or discard under a condition, seldom without one.
void Generator::leave() {
  const std::string condition = truth(2);
  std::string jump;
  if (in_loop_ && chance(60))
    jump = switches_ > 0 && chance(50) ? "break;" : pick({"break;", "continue;"});
  else if (switches_ > 0)
    jump = "break;";
  else if (in_main_ && allowed(15) && chance(40))
    jump = "discard;";
  if (switches_ > 1 && jump == "continue;") jump = "break;";  // Mesa goes wrong there (docs/hardening.md)
  if (jump.empty() && !in_main_ && allowed(16)) {
    line("if (" + condition + ") {");
    ++indent_;
    const std::size_t mark = scope_.size();
    line(current_.returns_value ? "return " + value(current_.result, 2) + ";" : "return;");
    scope_.resize(mark);
    --indent_;
    line("}");
  } else if (!jump.empty()) {
    line(chance(92) ? "if (" + condition + ") " + jump : jump);
  } else {
    assignment();
  }
}

// A function that may have side effects. What it writes does not overlap, and no index depends on it.
void Generator::call() {
  std::vector<const Function*> fit;
  for (const Function& f : functions_)
    if (affordable(f)) fit.push_back(&f);
  if (fit.empty()) return assignment();
  const Function& f = *pick(fit);
  std::vector<std::string> written;  // the variables, each once
  std::string arguments;
  for (const Parameter& p : f.parameters) {
    arguments += arguments.empty() ? "" : ", ";
    if (p.direction == Direction::in || p.direction == Direction::constant_in) {
      arguments += value(p.type, 2);
      continue;
    }
    std::vector<std::string> found = all_places(p.type, true);
    const auto root = [](const std::string& place) { return place.substr(0, place.find_first_of(".[")); };
    std::erase_if(found, [&](const std::string& place) {
      const auto taken = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), root(place)) != names.end();
      };
      return taken(written) || taken(globals_);
    });
    std::string chosen;
    if (found.empty()) {
      chosen = fresh();
      const std::string initial = value(p.type, 0);
      line(name_of(p.type) + " " + chosen + " = " + initial + ";");
      scope_.push_back({chosen, p.type, true, false});
    } else {
      chosen = pick(found);
    }
    written.push_back(root(chosen));
    arguments += chosen;
  }
  const std::string text = f.name + "(" + arguments + ")";
  cost_ += times_ * f.cost;
  if (!f.pure) current_.pure = false;
  if (f.returns_value && chance(85)) {
    const std::string name = fresh();
    line((holds_float(f.result, structures_) ? "precise " : "") + name_of(f.result) + " " + name + " = " + text + ";");
    scope_.push_back({name, f.result, true, false});
  } else {
    line(text + ";");
  }
}

void Generator::increment() {
  const Scalar base = chance(50) ? Scalar::i32 : Scalar::u32;
  const GlslType type = plain(base, allowed(0) ? 1 + below(3) : 1);
  const std::vector<std::string> found = all_places(type, true);
  if (found.empty()) return assignment();
  const std::string place = pick(found);
  line(chance(50) ? place + pick({"++", "--"}) + ";" : pick({"++", "--"}) + place + ";");
}

// One side effect within an expression: i++, an assignment as a value, a comma, a call that may be skipped.
void Generator::side_effects() {
  std::vector<std::string> plain_names;
  for (const Variable& v : scope_)
    if (v.writable && v.type == plain(Scalar::u32) &&
        std::count_if(scope_.begin(), scope_.end(), [&](const Variable& w) { return w.name == v.name; }) == 1)
      plain_names.push_back(v.name);
  if (plain_names.empty()) return assignment();
  const std::string changed = pick(plain_names);
  // What else stands in the expression is written before the variable can change, into one of its own.
  const std::string other = fresh();
  line("uint " + other + " = " + integer(plain(Scalar::u32), 2) + ";");
  const std::string result = fresh();
  switch (below(4)) {
    case 0:
      line("uint " + result + " = " + other + " * " + changed + pick({"++", "--"}) + ";");
      break;
    case 1:
      line("uint " + result + " = (" + changed + " += " + other + ") ^ 5u;");
      break;
    case 2:
      line("uint " + result + " = (" + changed + " = " + other + " + 3u, " + changed + " * 2u);");
      break;
    default:
      line("bool " + result + "_b = (" + other + " & 1u) == 0u " + pick({"&&", "||"}) + " ++" + changed + " > 7u;");
      line("uint " + result + " = uint(" + result + "_b) + " + changed + ";");
  }
  scope_.push_back({other, plain(Scalar::u32), true, false});
  scope_.push_back({result, plain(Scalar::u32), true, false});
}

}  // namespace twinshade::fuzz
