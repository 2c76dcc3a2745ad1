#include "evaluate/cases.h"

#include <doctest/doctest.h>

#include <cmath>
#include <ctime>

#include "base/error.h"
#include "evaluate/compare_outputs.h"
#include "tests/evaluate/tables.h"

using namespace twinshade;
using test::error_of;

namespace {

std::string refusal(const std::string& json) {
  return error_of([&] { parse_cases(json, "f.json"); });
}

// One input of this type and these rows.
std::string input(const std::string& type, const std::string& rows) {
  return R"({"values": {"inputs": [{"name": "x", "type": ")" + type + R"(", "values": )" + rows + "}]}}";
}

Cases expecting(const std::string& type, const std::string& rows, const std::string& tolerance) {
  return parse_cases(R"({"values": {"outputs": [{"name": "r", "type": ")" + type + R"(", "values": )" + rows +
                         R"(}]}, "tolerance": )" + tolerance + "}",
                     "f.json");
}

std::size_t failures(const Cases& cases, const Values& got) {
  EvaluatedRows rows;
  rows.outputs = {got};
  rows.kept.assign(cases.table.rows, 1);
  check_expected(cases, rows.outputs, "f.json");
  return compare_outputs(cases, rows).failures.size();
}

}  // namespace

TEST_CASE("values are read as GLSL takes them") {
  const Cases cases = parse_cases(
      R"({"values": {"inputs": [{"name": "m", "type": "mat2x3", "values": [[[1, 2, 3], [4, 5, 6]], [1, 2, 3, 4, 5, 6]]},
                                {"name": "i", "type": "int", "values": [-2147483648, [7]]},
                                {"name": "f", "type": "float", "values": ["-inf", "-0x1.8p-2"]},
                                {"name": "z", "type": "float", "values": [-0, 0]}],
                     "uniforms": [{"name": "b", "type": "bvec2", "values": [[true, 0]]}, {"name": "n", "type": "float", "values": ["nan"]}],
                     "outputs": [{"name": "r", "type": "float", "values": [null, 0.1]}]},
          "tolerance": {"ulp": 3, "rel": 0.5}})",
      "f.json");
  CHECK(cases.table.rows == 2);
  CHECK(value_at(cases.table.inputs[0], 0, 5) == 6);
  CHECK(value_at(cases.table.inputs[0], 1, 3) == 4);
  CHECK(value_at(cases.table.inputs[1], 0, 0) == -2147483648.0);
  CHECK(value_at(cases.table.inputs[2], 0, 0) == -INFINITY);
  CHECK(value_at(cases.table.inputs[2], 1, 0) == -0.375);
  CHECK(cases.table.inputs[3].bits == std::vector<std::uint32_t>{0x80000000u, 0});
  CHECK(cases.table.uniforms[0].bits == std::vector<std::uint32_t>{1, 0});
  CHECK(std::isnan(value_at(cases.table.uniforms[1], 0, 0)));
  CHECK(cases.expected[0].has_value == std::vector<std::uint8_t>{0, 1});
  CHECK(cases.expected[0].values.bits[1] == 0x3dcccccdu);
  CHECK(cases.tolerance.ulp == 3);
  CHECK(cases.tolerance.rel == 0.5);
}

TEST_CASE("decimals, hex floats and whole numbers become the nearest float, rounded once") {
  const auto bits = [](const std::string& number) {
    return parse_cases(input("float", "[" + number + "]"), "f.json").table.inputs[0].bits.at(0);
  };
  // Half-way between 1 and the next float, and next to it: as doubles all three are one.
  CHECK(bits("1.000000059604644775390625") == 0x3f800000u);
  CHECK(bits("1.00000005960464477539062501") == 0x3f800001u);
  CHECK(bits("-1.00000005960464477539062501") == 0xbf800001u);
  CHECK(bits("1.00000005960464477539062499") == 0x3f800000u);
  CHECK(bits("1.00000017881393432617187499") == 0x3f800001u);  // to even it would be ...2
  CHECK(bits("1.000000178813934326171875") == 0x3f800002u);
  CHECK(bits("\"0x1.000001000000000001p0\"") == 0x3f800001u);
  CHECK(bits("\"-0x1.000001000000000001p0\"") == 0xbf800001u);
  CHECK(bits("9007199791611905") == 0x5a000001u);  // 2^53 + 2^29 + 1
  CHECK(bits("-9007199791611905") == 0xda000001u);
  CHECK(bits("9007199791611904") == 0x5a000000u);
  CHECK(bits("3.4028235677973366e38") == 0x7f7fffffu);  // below the half-way to what would be 2^128
  CHECK(bits("0.1") == 0x3dcccccdu);
  CHECK(bits("1e-50") == 0);
  CHECK(bits("\"0x1p-2000\"") == 0);
  CHECK(bits("\"-0x.8p+1\"") == 0xbf800000u);
  CHECK(bits("-0.0") == 0x80000000u);
}

TEST_CASE("what is wrong with cases is said in one line") {
  CHECK(refusal("{\n\"values\": {\n  \"inputs\": [,]\n}}").find("f.json:3: malformed JSON: ") == 0);
  CHECK(refusal("").find("f.json:1: malformed JSON: ") == 0);
  CHECK(refusal("[1, 2]") == "f.json: the file must be a JSON object");
  CHECK(refusal("{}").find("f.json: no \"values\"") == 0);
  CHECK(refusal(R"({"value": {}})") == "f.json: unknown key 'value'; did you mean 'values'? (in the file)");
  CHECK(refusal(R"({"values": {"input": []}})") == "f.json: unknown key 'input'; did you mean 'inputs'? (in values)");
  CHECK(
      refusal(input("vec33", "[1]")).find("f.json: values.inputs[0] (x): unknown type 'vec33'; did you mean 'vec3'") ==
      0);
  CHECK(refusal(input("vec3", "[[1, 2]]")) ==
        "f.json: values.inputs[0] (x), row 0: vec3 has 3 components, but 2 are given");
  CHECK(refusal(input("int", "[1, 1.5]")) == "f.json: values.inputs[0] (x), row 1: 1.5 is no int");
  CHECK(refusal(input("uint", "[-1]")) == "f.json: values.inputs[0] (x), row 0: -1 is no uint");
  CHECK(refusal(input("int", "[-1e10]")) == "f.json: values.inputs[0] (x), row 0: -1e+10 is no int");
  CHECK(refusal(input("int", "[\"nan\"]")) == "f.json: values.inputs[0] (x), row 0: \"nan\" is no int");
  CHECK(refusal(input("int", "[true]")) == "f.json: values.inputs[0] (x), row 0: true is no int");
  CHECK(refusal(input("int[2][2]", "[[1, 2, 3, 4]]")) ==
        "f.json: values.inputs[0] (x): \"int[2][2]\": give each array of an array of arrays by itself, as x[0], x[1] "
        "...");
  CHECK(refusal(R"({"values": {"inputs": []},
"name": "a",

"values": {}})") == "f.json:4: \"values\" stands twice in one object: keep one");
  CHECK(refusal(input("bool", "[2]")) == "f.json: values.inputs[0] (x), row 0: 2 is no bool");
  CHECK(
      refusal(input("float", "[1e39]")) ==
      "f.json: values.inputs[0] (x), row 0: 1e+39 is beyond what a float holds: write \"inf\" where infinity is meant");
  CHECK(refusal(input("float", "[1,\n1e999]")) ==
        "f.json:2: 1e999 is beyond what a double holds: write \"inf\" where infinity is meant");
  CHECK(refusal(input("float", "[1" + std::string(1000000, '0') + "]")).size() < 200);
  CHECK(refusal(input("float", "[1" + std::string(1000000, '0') + "x]")).size() < 300);
  CHECK(refusal(input(std::string(1000000, 'v'), "[1]")).size() < 400);
  CHECK(refusal(input("float", "[]")) ==
        "f.json: values.inputs[0] (x) has no rows: give \"values\" one for each invocation");
  for (const char* text : {"0x-1", "0xinf", "0xnan", "0x", "0x1p", "0x1p+1 ", "--0x1p+1"})
    CHECK(refusal(input("float", "[\"" + std::string(text) + "\"]")).find("\" is no value: use numbers") !=
          std::string::npos);
  CHECK(refusal(input("float", "[\"0x1p+9999\"]")).find("is beyond what a double holds") != std::string::npos);
  std::string deep;
  for (int i = 0; i < 300000; ++i) deep += "{\"a\":";
  CHECK(refusal(input("float", "[" + deep + "1" + std::string(300000, '}') + "]")) ==
        "f.json: values.inputs[0] (x), row 0: {...} is no value: use numbers, true, false, or the strings \"inf\", "
        "\"-inf\", \"nan\", \"0x1.8p+1\"");
  CHECK(refusal(R"({"values": {"inputs": []}, "tolerance": {"ulp": 0.5}})") ==
        "f.json: tolerance.ulp counts representable floats: it must be a whole number");
  CHECK(refusal(input("float", "[{}]")).find("row 0: {} is no value") != std::string::npos);
  CHECK(refusal(input("float", "[null]")).find("row 0: null is no value") != std::string::npos);
  CHECK(refusal(input("float", std::string(100000, '[') + std::string(100000, ']'))).find("lists in lists") !=
        std::string::npos);
  CHECK(refusal(R"({"values": {"inputs": [{"name": "a", "type": "float", "values": [1, 2]},
                                          {"name": "b", "type": "float", "values": [1]}]}})") ==
        "f.json: input b has 1 rows, but the table has 2: row i of every list belongs together");
  CHECK(refusal(R"({"values": {"inputs": [{"name": "a", "type": "float", "values": [1]},
                                          {"name": "a", "type": "float", "values": [1]}]}})") ==
        "f.json: values.inputs: a is there twice");
  CHECK(refusal(R"({"values": {}, "tolerance": {"ulp": -1}})") == "f.json: tolerance.ulp must be a number, 0 or more");
  CHECK(refusal(R"({"values": {"inputs": [{"name": 1}]}})") == "f.json: values.inputs[0] needs a \"name\", a string");
}

TEST_CASE("a table of very many inputs is read in a time that grows as they do") {
  std::string list;
  for (int i = 0; i < 60000; ++i)
    list += (i > 0 ? ", " : "") + (R"({"name": "input_)" + std::to_string(i)) + R"(", "type": "float", "values": [1]})";
  const std::clock_t before = std::clock();
  CHECK(parse_cases(R"({"values": {"inputs": [)" + list + "]}}", "f.json").table.inputs.size() == 60000);
  CHECK(double(std::clock() - before) / CLOCKS_PER_SEC < 10);
}

TEST_CASE("rows of null whose type needs more memory than there is are refused before they take it") {
  std::string rows = "null";
  for (int i = 1; i < 100000; ++i) rows += ",null";
  const std::string said =
      refusal(R"({"values": {"outputs": [{"name": "x", "type": "mat4[65536]", "values": [)" + rows + "]}]}}");
  CHECK(said.find("f.json: values.outputs[0] (x) needs ") == 0);
  CHECK(said.find("give it fewer rows") != std::string::npos);
}

TEST_CASE("expected outputs have to be the shader's") {
  const auto check = [](const std::string& name, const std::string& type) {
    return error_of(
        [&] { check_expected(expecting("vec2", "[[1, 2]]", "{}"), {test::floats(name, type, {})}, "f.json"); });
  };
  CHECK(check("r", "vec2") == "");
  CHECK(check("rr", "vec2") == "f.json: unknown output 'r'; did you mean 'rr'?");
  CHECK(check("r", "vec3") == "f.json: output r is vec3 in the shader, but vec2 in the cases");
}

TEST_CASE("a float passes within any one tolerance") {
  const float one = 1, next = std::nextafter(1.0f, 2.0f);
  const auto fails = [&](const std::string& tolerance, float expected, float got) {
    Cases cases = expecting("float", "[0]", tolerance);
    cases.expected[0].values = test::floats("r", "float", {expected});
    cases.expected[0].values.doubles = {double(expected)};
    return failures(cases, test::floats("r", "float", {got})) == 1;
  };
  CHECK(fails("{}", one, next));
  CHECK_FALSE(fails(R"({"ulp": 1})", one, next));
  CHECK(fails(R"({"ulp": 1})", one, std::nextafter(next, 2.0f)));
  CHECK_FALSE(fails(R"({"abs": 0.5})", 1, 1.5f));
  CHECK(fails(R"({"abs": 0.5})", 1, 1.75f));
  CHECK_FALSE(fails(R"({"rel": 0.25})", 8, 10));
  CHECK(fails(R"({"rel": 0.25})", 8, 10.5f));
  CHECK_FALSE(fails("{}", 0.0f, -0.0f));
  CHECK_FALSE(fails("{}", NAN, -NAN));
  CHECK(fails(R"({"ulp": 4294967295, "abs": 1e30, "rel": 1e30})", 1, NAN));
  CHECK(fails(R"({"abs": 1e30, "rel": 1e30})", NAN, 1));
  CHECK(fails(R"({"abs": 1e30, "rel": 1})", INFINITY, -INFINITY));
  CHECK_FALSE(fails("{}", INFINITY, INFINITY));
  CHECK_FALSE(fails(R"({"ulp": 2})", 1e-45f, -1e-45f));  // the two denormals around 0
}

TEST_CASE("integers are held to their values whatever the tolerance") {
  CHECK(failures(expecting("int", "[5]", R"({"ulp": 10, "abs": 10})"), test::ints("r", "int", {6})) == 1);
  CHECK(failures(expecting("uvec2", "[[4294967295, 1]]", "{}"), test::ints("r", "uvec2", {4294967295, 1})) == 0);
}

TEST_CASE("a discarded row fails where something is expected of it") {
  EvaluatedRows rows;
  rows.outputs = {test::floats("r", "float", {0, 0})};
  rows.kept = {0, 0};
  const OutputComparison comparison = compare_outputs(expecting("float", "[null, 0]", "{}"), rows);
  REQUIRE(comparison.failures.size() == 1);
  CHECK(comparison.failures[0].row == 1);
  CHECK(comparison.failures[0].discarded);
  CHECK(comparison.failed_rows == 1);
}
