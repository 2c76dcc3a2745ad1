#include "evaluate/cases.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/memory.h"
#include "base/names.h"

namespace twinshade {
namespace {

using Json = nlohmann::json;

constexpr int kDeepestValue = 4;  // row, array element, column, component

std::vector<std::string> every_type_name() {
  std::vector<std::string> names;
  for (int scalar = 0; scalar < 4; ++scalar)
    for (std::uint32_t rows = 1; rows <= 4; ++rows) names.push_back(type_name({Scalar(scalar), 1, rows, 0}));
  for (std::uint32_t columns = 2; columns <= 4; ++columns)
    for (std::uint32_t rows = 2; rows <= 4; ++rows) names.push_back(type_name({Scalar::f32, columns, rows, 0}));
  return names;
}

// What a file says, as far as a message repeats it.
std::string shortened(const std::string& text, std::size_t most = 60) {
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

// A double that becomes the float nearest to the number that it was rounded from: where it lies half-way between two
// floats and the number does not, it moves one step to the number's side.
double towards(double value, float nearest) {
  const auto rounded = float(value);
  return rounded == nearest ? value : std::nextafter(value, double(nearest));
}

// value: what the text was read as; format: its.
double rounded_once(double value, const std::string& text, std::chars_format format = std::chars_format::general) {
  float nearest = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), nearest, format);
  return error == std::errc() && end == text.data() + text.size() ? towards(value, nearest) : value;
}

// "inf", "-inf", "nan", and hex floats as C writes them: what JSON's numbers cannot say.
std::optional<double> number_in_text(std::string_view text) {
  const bool negative = text.substr(0, 1) == "-";
  if (negative) text.remove_prefix(1);
  const double sign = negative ? -1 : 1;
  if (text == "inf") return sign * std::numeric_limits<double>::infinity();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text.substr(0, 2) != "0x") return std::nullopt;
  text.remove_prefix(2);
  constexpr std::string_view kFirst = ".0123456789abcdefABCDEF";  // no sign, no inf
  if (text.empty() || kFirst.find(text[0]) == std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::hex);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::strtod(("0x" + std::string(text)).c_str(), nullptr) * sign;
  return sign * rounded_once(value, std::string(text), std::chars_format::hex);
}

// Reads text and notes how far it has come: the parser does not say where a key stands.
struct NotingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  NotingIterator& operator++() {
    *reached = ++at;
    return *this;
  }
  bool operator==(const NotingIterator& other) const { return at == other.at; }
};

// JSON as a tree whose decimals are rounded_once. Of what is malformed it keeps what is to be said.
class TreeBuilder final : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

  Json tree;
  std::string error;

  // Whether it is JSON.
  bool parse() {
    return Json::sax_parse(NotingIterator{reached_, &reached_}, NotingIterator{text_.data() + text_.size(), &reached_},
                           this);
  }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  // Of integers that begin with a minus sign, 0 among them.
  bool number_integer(Json::number_integer_t value) override { return value == 0 ? add(-0.0) : add(value); }
  bool number_unsigned(Json::number_unsigned_t value) override { return add(value); }
  bool number_float(double value, const std::string& text) override { return add(rounded_once(value, text)); }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(Json::binary_t&) override { return false; }  // JSON has none
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    if (open_.back()->contains(name)) {
      error = place_of(std::size_t(reached_ - text_.data())) + "\"" + shortened(name) +
              "\" stands twice in one object: keep one";
      return false;
    }
    key_ = name;
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& e) override {
    error = place_of(position);
    if (e.id == 406) {  // out_of_range
      error += shortened(token) + " is beyond what a double holds: write \"inf\" where infinity is meant";
      return false;
    }
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    const std::string what = e.what();
    const std::size_t line = what.find("line "), colon = what.find(": ", line);
    const bool placed = line != std::string::npos && colon != std::string::npos;
    error += "malformed JSON: " + shortened(what.substr(placed ? colon + 2 : what.find("] ") + 2), 160);
    return false;
  }

 private:
  std::string place_of(std::size_t position) const {
    const std::string_view before = text_.substr(0, position);
    return origin_ + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ": ";
  }
  Json& place(Json&& value) {
    if (open_.empty()) return tree = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_array()) return parent.emplace_back(std::move(value));
    return parent[key_] = std::move(value);
  }
  bool add(Json&& value) {
    place(std::move(value));
    return true;
  }
  bool open(Json&& value) {
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string_view text_;
  const std::string& origin_;
  const char* reached_ = text_.data();
  std::vector<Json*> open_;  // what is not closed yet, the outermost first; no sibling moves one while it is open
  std::string key_;
};

class CasesReader {
 public:
  explicit CasesReader(const std::string& origin) : origin_(origin) {}

  Cases read(std::string_view text) {
    const Json file = parse(text);
    require_keys(file, "the file", {"values", "tolerance", "name", "description"});
    if (!file.contains("values"))
      fail("no \"values\": the file needs {\"values\": {\"inputs\": [...], \"outputs\": [...]}}");
    const Json& values = file["values"];
    require_keys(values, "values", {"inputs", "uniforms", "outputs"});
    Cases cases;
    cases.table.origin = origin_;
    for (Column& column : columns(values, "inputs")) cases.table.inputs.push_back(std::move(column.values));
    for (Column& column : columns(values, "uniforms")) cases.table.uniforms.push_back(std::move(column.values));
    for (Column& column : columns(values, "outputs"))
      cases.expected.push_back({std::move(column.values), std::move(column.has_value)});
    cases.table.rows = row_count(cases);
    for (ExpectedOutput& output : cases.expected) require_rows(output.values, "output", cases.table.rows, false);
    if (file.contains("tolerance")) cases.tolerance = tolerance(file["tolerance"]);
    return cases;
  }

 private:
  struct Column {
    Values values;
    std::vector<std::uint8_t> has_value;
  };

  [[noreturn]] void fail(const std::string& what) const { throw UserError(origin_ + ": " + what); }

  Json parse(std::string_view text) const {
    TreeBuilder builder(text, origin_);
    if (!builder.parse()) throw UserError(builder.error);
    return std::move(builder.tree);
  }

  void require_keys(const Json& object, const std::string& what, const std::vector<std::string>& keys) const {
    if (!object.is_object()) fail(what + " must be a JSON object");
    for (const auto& [key, value] : object.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail(unknown_name_message("key", shortened(key), keys) + " (in " + what + ")");
  }

  std::vector<Column> columns(const Json& values, const std::string& kind) const {
    std::vector<Column> result;
    if (!values.contains(kind)) return result;
    const Json& list = values[kind];
    if (!list.is_array()) fail("values." + kind + " must be a list");
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
      result.push_back(column(list[i], "values." + kind + "[" + std::to_string(i) + "]", kind == "outputs"));
      if (const std::string& name = result.back().values.name; !names.insert(name).second)
        fail("values." + kind + ": " + name + " is there twice");
    }
    return result;
  }

  std::string text_of(const Json& object, const char* key, const std::string& what) const {
    if (!object.contains(key) || !object[key].is_string()) fail(what + " needs a \"" + key + "\", a string");
    return object[key].get<std::string>();
  }

  Column column(const Json& object, std::string what, bool may_be_null) const {
    require_keys(object, what, {"name", "type", "values"});
    Column column;
    Values& values = column.values;
    values.name = text_of(object, "name", what);
    what += " (" + shortened(values.name) + ")";
    const std::string type = text_of(object, "type", what);
    const std::optional<ValueType> found = find_type(type);
    if (!found) {
      const std::string message = unknown_name_message("type", shortened(type), every_type_name());
      const bool nested = std::count(type.begin(), type.end(), '[') > 1;
      fail(what + ": " +
           (nested ? "\"" + shortened(type) + "\": give each array of an array of arrays by itself, as " + values.name +
                         "[0], " + values.name + "[1] ..."
                   : message + "; arrays are written \"vec3[4]\""));
    }
    values.type = *found;
    if (!object.contains("values") || !object["values"].is_array()) fail(what + " needs \"values\", a list of rows");
    const Json& rows = object["values"];
    if (rows.empty()) fail(what + " has no rows: give \"values\" one for each invocation");
    require_room(values.type, rows.size(), what);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const std::string where = what + ", row " + std::to_string(row);
      const std::size_t before = values.doubles.size();
      column.has_value.push_back(!(may_be_null && rows[row].is_null()));
      if (column.has_value.back())
        append(values, rows[row], where, 0);
      else
        values.bits.resize(before + values.type.components()), values.doubles.resize(before + values.type.components());
      const std::size_t count = values.doubles.size() - before;
      if (count != values.type.components())
        fail(where + ": " + type_name(values.type) + " has " + std::to_string(values.type.components()) +
             " components, but " + std::to_string(count) + " are given");
    }
    return column;
  }

  // Rows of null take as much as those with values, though a short file may have many.
  void require_room(const ValueType& type, std::size_t rows, const std::string& what) const {
    constexpr std::uint64_t kComponent = sizeof(Values::bits[0]) + sizeof(Values::doubles[0]);
    constexpr std::uint64_t kLarge = std::uint64_t{64} << 20;  // what is below finds memory enough: not asked for
    const std::uint64_t bytes = std::uint64_t{rows} * type.components() * kComponent;
    if (bytes > kLarge)
      require_memory(bytes, origin_ + ": " + what, "give it fewer rows, or the type that it has in the shader");
  }

  // Nested lists are what they hold, one after the other.
  void append(Values& values, const Json& value, const std::string& where, int depth) const {
    if (value.is_array()) {
      if (depth == kDeepestValue) fail(where + ": lists in lists in lists: at most array, column, component");
      for (const Json& item : value) append(values, item, where, depth + 1);
      return;
    }
    if (value.is_boolean() && values.type.scalar != Scalar::boolean)
      fail(where + ": " + shown(value) + " is no " + type_name({values.type.scalar, 1, 1, 0}));
    const double number = number_of(value, where);
    values.doubles.push_back(number);
    values.bits.push_back(bits_of(number, values.type.scalar, value, where));
  }

  double number_of(const Json& value, const std::string& where) const {
    if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
    if (value.is_number_unsigned())
      return towards(value.get<double>(), float(value.get_ref<const Json::number_unsigned_t&>()));
    if (value.is_number_integer())
      return towards(value.get<double>(), float(value.get_ref<const Json::number_integer_t&>()));
    if (value.is_number()) return value.get<double>();
    if (value.is_string())
      if (const std::optional<double> number = number_in_text(value.get_ref<const std::string&>())) {
        if (std::isinf(*number) && value.get_ref<const std::string&>().find('x') != std::string::npos)
          fail(where + ": " + shown(value) + " is beyond what a double holds: write \"inf\" where infinity is meant");
        return *number;
      }
    fail(where + ": " + shown(value) +
         " is no value: use numbers, true, false, or the strings \"inf\", \"-inf\", \"nan\", \"0x1.8p+1\"");
  }

  // As it was written, or shorter.
  static std::string shown(const Json& value) {
    if (value.is_structured() && !value.empty()) return value.is_array() ? "[...]" : "{...}";  // however deep it is
    if (value.is_number_float()) {
      char text[32];
      const auto [end, error] = std::to_chars(text, text + sizeof text, value.get<double>());
      return {text, end};
    }
    return value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40);
  }

  std::uint32_t bits_of(double value, Scalar scalar, const Json& written, const std::string& where) const {
    if (scalar == Scalar::f32) {
      const float rounded = float(value);
      if (std::isinf(rounded) && !std::isinf(value))
        fail(where + ": " + shown(written) + " is beyond what a float holds: write \"inf\" where infinity is meant");
      return std::bit_cast<std::uint32_t>(rounded);
    }
    const double least = scalar == Scalar::i32 ? -2147483648.0 : 0;
    const double most = scalar == Scalar::i32 ? 2147483647.0 : scalar == Scalar::u32 ? 4294967295.0 : 1;
    if (!(value >= least && value <= most) || value != std::floor(value))
      fail(where + ": " + shown(written) + " is no " + type_name({scalar, 1, 1, 0}));
    return scalar == Scalar::i32 ? std::bit_cast<std::uint32_t>(std::int32_t(value)) : std::uint32_t(value);
  }

  void require_rows(const Values& values, const char* kind, std::size_t rows, bool one_is_enough) const {
    if (values.row_count() == rows || (one_is_enough && values.row_count() == 1)) return;
    fail(std::string(kind) + " " + values.name + " has " + std::to_string(values.row_count()) +
         " rows, but the table has " + std::to_string(rows) + ": row i of every list belongs together");
  }

  // As many as the longest list has; every input has as many.
  std::size_t row_count(const Cases& cases) const {
    std::size_t rows = 1;
    for (const Values& values : cases.table.inputs) rows = std::max(rows, values.row_count());
    for (const Values& values : cases.table.uniforms) rows = std::max(rows, values.row_count());
    for (const ExpectedOutput& output : cases.expected) rows = std::max(rows, output.values.row_count());
    if (rows > kMostTableRows)
      fail(std::to_string(rows) + " rows are more than the " + std::to_string(kMostTableRows) +
           " that a table may have");
    for (const Values& values : cases.table.inputs) require_rows(values, "input", rows, false);
    for (const Values& values : cases.table.uniforms) require_rows(values, "uniform", rows, true);
    return rows;
  }

  Tolerance tolerance(const Json& object) const {
    require_keys(object, "tolerance", {"ulp", "abs", "rel"});
    const auto number = [&](const char* key) {
      if (!object.contains(key)) return 0.0;
      const Json& value = object[key];
      if (!value.is_number() || !(value.get<double>() >= 0))
        fail(std::string("tolerance.") + key + " must be a number, 0 or more");
      return value.get<double>();
    };
    const double ulp = number("ulp");
    if (ulp != std::floor(ulp)) fail("tolerance.ulp counts representable floats: it must be a whole number");
    return {std::uint64_t(std::min(ulp, 4294967295.0)), number("abs"), number("rel")};
  }

  const std::string& origin_;
};

}  // namespace

Cases parse_cases(std::string_view json, const std::string& origin) { return CasesReader(origin).read(json); }

void check_expected(const Cases& cases, const std::vector<Values>& outputs, const std::string& origin) {
  std::vector<std::string> names;
  for (const Values& output : outputs) names.push_back(output.name);
  for (const ExpectedOutput& expected : cases.expected) {
    const Values* output = find_values(outputs, expected.values.name);
    if (!output) throw UserError(origin + ": " + unknown_name_message("output", expected.values.name, names));
    if (output->type != expected.values.type)
      throw UserError(origin + ": output " + output->name + " is " + type_name(output->type) + " in the shader, but " +
                      type_name(expected.values.type) + " in the cases");
  }
}

}  // namespace twinshade
