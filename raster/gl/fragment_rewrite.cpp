#include "raster/gl/fragment_rewrite.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "cpu_shaders/rewrite/exact_functions.h"
#include "cpu_shaders/source/preprocess.h"
#include "raster/gl/author_names.h"
#include "raster/gl/constant_integer.h"
#include "raster/gl/declaration.h"
#include "raster/gl/extended_products.h"

namespace twinshade::gl {
namespace {

struct ValueType {
  Scalar scalar;
  std::uint32_t columns, rows;
};

// float, vecN, ivecN, uvecN, matN, matCxR.
std::optional<ValueType> value_type(const std::string& name) {
  static const std::map<std::string, ValueType> types = [] {
    std::map<std::string, ValueType> all = {
        {"float", {Scalar::f32, 1, 1}}, {"int", {Scalar::i32, 1, 1}}, {"uint", {Scalar::u32, 1, 1}}};
    for (std::uint32_t n = 2; n <= 4; ++n) {
      const std::string digit = std::to_string(n);
      all["vec" + digit] = {Scalar::f32, 1, n};
      all["ivec" + digit] = {Scalar::i32, 1, n};
      all["uvec" + digit] = {Scalar::u32, 1, n};
      all["mat" + digit] = {Scalar::f32, n, n};
      for (std::uint32_t rows = 2; rows <= 4; ++rows)
        all["mat" + digit + "x" + std::to_string(rows)] = {Scalar::f32, n, rows};
    }
    return all;
  }();
  const auto found = types.find(name);
  if (found == types.end()) return std::nullopt;
  return found->second;
}

bool is_any(const std::string& text, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return text == name; });
}

class Rewriter {
 public:
  Rewriter(const ShaderSource& source, InputStyle style)
      : source_(source), style_(style), text_(tokenize(source)), tokens_(text_.tokens) {}

  FragmentShader run() {
    result_.extensions = text_.extensions;
    refuse_own_names();
    rename_new_words(source_, tokens_);
    scan_words();
    bool has_main = false;
    for (const Declaration& d : split_declarations(source_, tokens_)) {
      const bool input = has(d, "in"), output = has(d, "out");
      if (d.kind == Declaration::Kind::function && tokens_[d.type + 1].text == "main") has_main = true;
      if (d.kind == Declaration::Kind::qualifiers_only) stage_qualifiers(d);
      if (d.kind == Declaration::Kind::block && input) input_block(d);
      if (d.kind == Declaration::Kind::block && output)
        fail(d.type, "an interface block cannot be a fragment shader's output");
      if (d.kind != Declaration::Kind::variables || d.declarators.empty()) continue;
      if (input)
        inputs(d);
      else if (output)
        outputs(d);
      else if (has(d, "const"))
        remember_constants(d);
      else if (!has(d, "uniform") && style_ != InputStyle::varyings)
        move_initializers(d);
    }
    if (!has_main)
      throw UserError((source_.files.empty() ? source_.name : source_.files[0]) + ": the shader has no main()");
    rename_words();
    result_.extended_products = redirect_extended_products(tokens_);
    result_.text = join(text_);
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(std::size_t token, const std::string& what) const {
    throw UserError(position(source_, tokens_[token]) + what);
  }

  bool has(const Declaration& d, const char* qualifier) const {
    return std::any_of(d.qualifiers.begin(), d.qualifiers.end(),
                       [&](std::size_t t) { return tokens_[t].text == qualifier; });
  }

  void refuse_own_names() const {
    for (std::size_t i = 0; i < tokens_.size(); ++i)
      if (tokens_[i].kind == Token::Kind::name && tokens_[i].text.rfind(kPrefix, 0) == 0)
        fail(i, "names that begin with " + std::string(kPrefix) + " are reserved: rename " + tokens_[i].text);
  }

  void scan_words() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const std::string& text = tokens_[i].text;
      if (tokens_[i].kind != Token::Kind::name) continue;
      ++count_[text];
      result_.discards |= text == "discard";
      result_.has_storage |= text == "buffer";
      result_.writes_depth |= text == "gl_FragDepth";
      result_.uses_fragment_position |= is_any(text, {"gl_FragCoord", "gl_FrontFacing"});
      if (text == "gl_ClipDistance" || text == "gl_CullDistance")
        fail(i, text + " is not supported: no clip planes are drawn with");
      if (i + 1 >= tokens_.size() || tokens_[i + 1].text != "(") continue;
      note_derivative(tokens_[i]);
      if (text.rfind("interpolateAt", 0) == 0 && style_ != InputStyle::varyings) interpolate_at_center(i);
    }
  }

  // Of one sample a pixel the centroid and the sample are its centre, where exact attributes are: the input itself, in
  // the call's parentheses. The sample's number goes with the call, so it may have no effects.
  void interpolate_at_center(std::size_t name) {
    const std::string called = tokens_[name].text;
    const auto refuse = [&](const char* why) { fail(name, called + " needs native attributes: " + why); };
    if (!is_any(called, {"interpolateAtCentroid", "interpolateAtSample"}))
      refuse("exact ones are evaluated at pixel centres only");
    std::size_t comma = 0, end = name + 2;
    bool plain = true;
    for (int depth = 1; end < tokens_.size(); ++end) {
      const std::string& text = tokens_[end].text;
      depth += is_any(text, {"(", "["}) ? 1 : is_any(text, {")", "]"}) ? -1 : 0;
      if (depth == 0) break;
      if (depth == 1 && text == ",") comma = end;
      if (comma > 0 && comma < end && is_any(text, {"(", "++", "--", "=", "+=", "-=", "*=", "/=", "%="})) plain = false;
    }
    if (comma > 0 && !plain) refuse("without them the sample may have no effects and no calls");
    erase(name, name + 1);
    if (comma > 0) erase(comma, end);
  }

  // The first that the author takes. Exact functions stand before the shader: theirs are taken by who calls them.
  void note_derivative(const Token& token) {
    const std::string where = position(source_, token), exact = "exact_";
    const bool within_exact = where.rfind(std::string(lint_detail::kExactFunctions) + ":", 0) == 0;
    const bool calls_exact = exact_derivative_ && !within_exact && token.text.rfind(exact, 0) == 0;
    const std::string called = calls_exact ? token.text.substr(exact.size()) : token.text;
    if (!is_any(called, {"dFdx", "dFdy", "fwidth", "dFdxFine", "dFdyFine", "fwidthFine", "dFdxCoarse", "dFdyCoarse",
                         "fwidthCoarse"}))
      return;
    if (!result_.derivative.empty() && (within_exact || !exact_derivative_)) return;
    result_.derivative = where + called;
    exact_derivative_ = within_exact;
  }

  void rename_words() {
    for (Token& token : tokens_) {
      if (token.text == "main") token.text = kUserMain;
      if (style_ == InputStyle::varyings) continue;
      if (token.text == "gl_FragCoord") token.text = kFragCoord;
      if (token.text == "gl_FrontFacing") token.text = kFrontFacing;
      if (token.text == "gl_PrimitiveID") token.text = kPrimitiveId;
    }
  }

  void erase(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) tokens_[i].text.clear();
  }

  bool layout_has(const Declaration& d, const char* word) const {
    for (const auto& [begin, end] : d.layouts)
      for (std::size_t i = begin; i < end; ++i)
        if (tokens_[i].text == word) return true;
    return false;
  }

  std::optional<long> layout_value(const Declaration& d, const char* word) const {
    for (const auto& [begin, end] : d.layouts)
      for (std::size_t i = begin; i + 1 < end; ++i) {
        if (tokens_[i].text != word || tokens_[i + 1].text != "=") continue;
        std::size_t last = i + 2;
        for (int depth = 0; last < end && (depth > 0 || !is_any(tokens_[last].text, {",", ")"})); ++last)
          depth += tokens_[last].text == "(" ? 1 : tokens_[last].text == ")" ? -1 : 0;
        const auto value = constant_integer(tokens_, i + 2, last, constants_);
        if (!value) fail(i, std::string("the value of layout(") + word + ") is not a constant that can be read here");
        return value;
      }
    return std::nullopt;
  }

  // Written out of the declaration: its storage, interpolation and layout. What stays: precise, highp ...
  void make_global(const Declaration& d) {
    for (const auto& [begin, end] : d.layouts) erase(begin, end);
    for (const std::size_t q : d.qualifiers)
      if (!is_any(tokens_[q].text, {"precise", "highp", "mediump", "lowp"})) erase(q, q + 1);
  }

  void stage_qualifiers(const Declaration& d) {
    if (style_ == InputStyle::globals && has(d, "in") && layout_has(d, "early_fragment_tests"))
      fail(d.begin, "layout(early_fragment_tests) needs native attributes: exact ones come with a computed depth");
  }

  // Redeclared built-ins; true if this was one.
  bool built_in(const Declaration& d) {
    const std::string& name = tokens_[d.declarators.front().name].text;
    if (name.rfind("gl_", 0) != 0) return false;
    if (layout_has(d, "origin_upper_left") || layout_has(d, "pixel_center_integer"))
      fail(d.begin, "gl_FragCoord with origin_upper_left or pixel_center_integer is not supported");
    if (!is_any(name, {"gl_FragCoord", "gl_FragDepth"})) fail(d.begin, "redeclaring " + name + " is not supported");
    if (style_ != InputStyle::varyings) erase(d.begin, d.end);
    return true;
  }

  std::uint32_t array_length(const Declaration& d, const Declarator& item, const char* what) const {
    if (item.arrays.size() + d.type_arrays.size() == 0) return 0;
    if (item.arrays.size() + d.type_arrays.size() > 1)
      fail(item.name,
           std::string(what) + " " + tokens_[item.name].text + " is an array of arrays, which is not supported");
    const auto [begin, end] = item.arrays.empty() ? d.type_arrays.front() : item.arrays.front();
    const auto length = constant_integer(tokens_, begin, end, constants_);
    if (!length || *length < 1 || *length > 1024)
      fail(item.name,
           std::string(what) + " " + tokens_[item.name].text + " needs an array size of 1 to 1024 written as a number");
    return std::uint32_t(*length);
  }

  void inputs(const Declaration& d) {
    if (built_in(d)) return;
    const std::string& type_name = tokens_[d.type].text;
    const auto type = value_type(type_name);
    if (!type || d.inline_struct)
      fail(d.type, "an input of type " + type_name + " is not supported: use float, int, uint, vectors or matrices");
    const char* interpolation = has(d, "flat") ? "flat" : has(d, "noperspective") ? "noperspective" : "";
    if (style_ == InputStyle::globals && std::string(interpolation) == "noperspective")
      fail(d.begin, "noperspective needs native attributes: exact ones are perspective-correct");
    if (type->scalar != Scalar::f32) interpolation = "flat";
    for (const Declarator& item : d.declarators) {
      Input input;
      input.where = tokens_[item.name];
      input.name = input.where.text;
      input.type = type_name;
      input.scalar = type->scalar;
      input.columns = type->columns, input.rows = type->rows;
      input.array_length = array_length(d, item, "input");
      input.interpolation = interpolation;
      input.per_sample = has(d, "sample");
      input.used = count_[input.name] > 1;
      result_.inputs.push_back(input);
    }
    if (style_ != InputStyle::varyings)
      make_global(d);
    else
      for (const auto& [begin, end] : d.layouts) erase(begin, end);
  }

  // in Block { flat int a; vec3 b; } c;   becomes   struct Block { int a; vec3 b; } c;   and its members globals where
  // there is no c.
  void input_block(const Declaration& d) {
    if (style_ == InputStyle::varyings)
      fail(d.type, "input block " + tokens_[d.type].text + " needs exact attributes: declare its members as inputs");
    const std::size_t open = d.type + 1;
    std::size_t close = open;
    while (tokens_[close].text != "}") ++close;
    const bool named = tokens_[close + 1].kind == Token::Kind::name;
    std::vector<std::string> prefixes = {named ? tokens_[close + 1].text + "." : ""};
    if (named && tokens_[close + 2].text == "[") {
      std::size_t end = close + 3;
      while (tokens_[end].text != "]") ++end;
      const auto length = constant_integer(tokens_, close + 3, end, constants_);
      if (!length || *length < 1 || *length > 64 || tokens_[end + 1].text != ";")
        fail(d.type, "input block " + tokens_[d.type].text + " needs one array size of 1 to 64 written as a number");
      prefixes.clear();
      for (long k = 0; k < *length; ++k) prefixes.push_back(tokens_[close + 1].text + "[" + std::to_string(k) + "].");
    }
    std::set<std::string> own;
    for (const std::size_t q : d.qualifiers) own.insert(tokens_[q].text);
    const std::vector<Token> body(tokens_.begin() + long(open) + 1, tokens_.begin() + long(close));
    std::vector<Input> members;
    for (const Declaration& member : split_declarations(source_, body)) {
      std::set<std::string> words = own;
      for (const std::size_t q : member.qualifiers) words.insert(body[q].text);
      const std::string& type_name = body[member.type].text;
      const auto type = value_type(type_name);
      if (!type || member.kind != Declaration::Kind::variables)
        fail(open + 1 + member.type,
             "a member of type " + type_name +
                 " in an input block is not supported: use float, int, uint, vectors or matrices");
      for (const Declarator& item : member.declarators) {
        Input input;
        input.where = body[item.name];
        input.name = input.where.text;
        input.type = type_name;
        input.scalar = type->scalar, input.columns = type->columns, input.rows = type->rows;
        if (!item.arrays.empty()) {
          const auto [begin, end] = item.arrays.front();
          const auto length = constant_integer(body, begin, end, constants_);
          if (!length || *length < 1 || item.arrays.size() > 1)
            fail(open + 1 + item.name, "member " + input.name + " needs one array size written as a number");
          input.array_length = std::uint32_t(*length);
        }
        if (words.count("flat") || type->scalar != Scalar::f32) input.interpolation = "flat";
        if (style_ == InputStyle::globals && words.count("noperspective"))
          fail(open + 1 + item.name, "noperspective needs native attributes: exact ones are perspective-correct");
        input.used = count_[input.name] > 1;
        members.push_back(input);
      }
      for (const std::size_t q : member.qualifiers) erase(open + 1 + q, open + 2 + q);
      for (const auto& [begin, end] : member.layouts) erase(open + 1 + begin, open + 1 + end);
    }
    for (const std::string& prefix : prefixes)
      for (Input input : members) {
        input.name = prefix + input.name;
        result_.inputs.push_back(input);
      }
    make_global(d);
    if (named)
      tokens_[d.type].text = "struct " + tokens_[d.type].text;
    else
      erase(d.type, open + 1), erase(close, d.end);
  }

  void outputs(const Declaration& d) {
    if (built_in(d)) return;
    const std::string& type_name = tokens_[d.type].text;
    const auto type = value_type(type_name);
    if (!type || type->columns != 1 || d.inline_struct)
      fail(d.type, "an output of type " + type_name + " is not supported: use float, int, uint or vectors");
    if (layout_value(d, "index").value_or(0) != 0)
      fail(d.begin, "a second source for blending (index = 1) is not supported");
    const int location = int(layout_value(d, "location").value_or(-1));
    for (const Declarator& item : d.declarators) {
      result_.outputs.push_back(
          {tokens_[item.name].text, type->scalar, type->rows, array_length(d, item, "output"), location});
    }
    // rows: who runs those refuses as many of the author's, and has probes, whose outputs come on top
    if (result_.outputs.size() > 8 && style_ != InputStyle::rows) fail(d.begin, "more than 8 outputs");
    make_global(d);
  }

  void remember_constants(const Declaration& d) {
    if (!is_any(tokens_[d.type].text, {"int", "uint"})) return;
    for (const Declarator& item : d.declarators) {
      if (!item.equals) continue;
      if (const auto value = constant_integer(tokens_, *item.equals + 1, item.end, constants_))
        constants_[tokens_[item.name].text] = *value;
    }
  }

  std::string spelled(std::size_t begin, std::size_t end) const {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) text += (i == begin ? "" : " ") + tokens_[i].text;
    return text;
  }

  // GLSL gives globals their values before main() begins: before the generated main() has filled the inputs. So
  //   float a = f(x), b = a;   becomes   float a; void init_0() { float value = f(x); a = value; } float b; ...
  // on the same lines, to be called once the inputs are there.
  void move_initializers(const Declaration& d) {
    if (std::none_of(d.declarators.begin(), d.declarators.end(),
                     [](const Declarator& i) { return i.equals.has_value(); }))
      return;
    std::string type = spelled(d.begin, d.declarators.front().name);
    if (d.inline_struct) {  // defined alone, then used by its name
      if (tokens_[d.type + 1].text == "{")
        fail(d.begin, "a struct without a name that is given a value: give it a name");
      const std::size_t first = d.declarators.front().name;
      std::size_t close = first;
      while (tokens_[close].text != "}") --close;
      type = spelled(d.begin, d.type) + (d.begin == d.type ? "" : " ") + tokens_[d.type + 1].text + " " +
             spelled(close + 1, first);
      tokens_[close].text = "}; " + type;
      for (std::size_t i = close + 1; i < first; ++i) tokens_[i].text.clear();
    }
    for (const Declarator& item : d.declarators) {
      const std::string name = tokens_[item.name].text;
      const bool last = tokens_[item.end].text == ";";
      std::string separator = last ? ";" : "; " + type;
      if (item.equals) {
        const bool unsized =
            std::any_of(item.arrays.begin(), item.arrays.end(), [](auto a) { return a.first == a.second; }) ||
            std::any_of(d.type_arrays.begin(), d.type_arrays.end(), [](auto a) { return a.first == a.second; });
        if (unsized)
          fail(item.name, "global array " + name + " takes its size from its value: write the size, or make it const");
        const std::string sizes = spelled(item.name + 1, *item.equals);
        const std::string function = kPrefix + std::string("initialize_") + std::to_string(result_.initializers.size());
        tokens_[*item.equals].text = "; void " + function + "() { " + type + " " + kPrefix + "value" + sizes + " =";
        separator = "; " + name + " = " + kPrefix + "value; }" + (last ? "" : " " + type);
        result_.initializers.push_back(function);
      }
      tokens_[item.end].text = separator;
    }
  }

  const ShaderSource& source_;
  const InputStyle style_;
  TokenList text_;
  std::vector<Token>& tokens_;
  std::map<std::string, int> count_;
  std::map<std::string, long> constants_;
  bool exact_derivative_ = false;  // the derivative that was noted is taken within an exact function
  FragmentShader result_;
};

}  // namespace

FragmentShader rewrite_fragment_shader(const ShaderSource& source, InputStyle style) {
  return Rewriter(source, style).run();
}

}  // namespace twinshade::gl
